// A vendor's library that needs another one, which is not there.
// SPDX-License-Identifier: Apache-2.0
extern "C" {
int fake_vendor_part();
int fake_vendor_whole() { return fake_vendor_part(); }
}
