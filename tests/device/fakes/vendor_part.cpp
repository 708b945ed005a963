// A library whose file is named otherwise than what its users look for: to them it is missing.
// SPDX-License-Identifier: Apache-2.0
extern "C" int fake_vendor_part() { return 1; }
