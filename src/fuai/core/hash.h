// A hash over the bits of a state: two runs agree when their hashes do.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace fuai {

/// Sixteen lower-case hexadecimal digits. Thread class: any.
inline std::string hash_text(std::uint64_t hash) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (unsigned i = 0; i < 16; ++i) text[i] = kDigits[(hash >> (60 - 4 * i)) & 0xf];
  return text;
}

/// FNV-1a, 64 bit, over the bytes fed to it. Thread class: real-time.
class StateHash {
 public:
  void add(const void* bytes, std::size_t size) noexcept {
    const auto* p = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ULL;
  }
  void add(std::span<const double> values) noexcept { add(values.data(), values.size_bytes()); }
  void add(double value) noexcept { add(&value, sizeof value); }

  std::uint64_t value() const noexcept { return value_; }
  std::string hex() const { return hash_text(value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace fuai
