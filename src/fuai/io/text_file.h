// Reads whole text files as UTF-8 and writes files whole or not at all.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "fuai/core/error.h"

namespace fuai {

/// Largest text file that is read [bytes]. A FAB physics file has 1 MB, a day of KES curves a few.
inline constexpr std::uint64_t kLargestTextFile = 64ULL * 1024 * 1024;

/// Reads a file byte by byte as it is. A file beyond the limit is refused by its size, without reading it.
/// @param limit largest accepted size [bytes]
/// @throws Error (kBadInput), each with its own sentence, when the file does not exist, is a directory, is
/// not a regular file, cannot be opened or read, is empty, or is larger than the limit. Thread class: set-up.
std::string read_bytes(const std::string& path, std::uint64_t limit = kLargestTextFile);

/// Turns the bytes of a text file into UTF-8 without byte order mark and with "\n" line ends. Valid UTF-8 is
/// kept; anything else is taken for CP932 (the Japanese encoding of Windows).
/// @param name file name for messages
/// @throws Error (kBadInput) when there is no text, a NUL byte (binary file, UTF-16), or neither encoding
/// fits. Thread class: set-up.
std::string decode_text(std::string_view bytes, const std::string& name);

/// Where in a text a byte stands: 1-based line, and column counted in bytes.
/// @param offset of the byte, at most the size @param name file name. Thread class: any.
Where place_of(std::string_view bytes, std::size_t offset, const std::string& name);

/// read_bytes() and decode_text(). Thread class: set-up.
std::string read_text_file(const std::string& path, std::uint64_t limit = kLargestTextFile);

/// Writes a file whole or not at all: a temporary file in the same folder, fsync, rename. An existing file
/// keeps its permissions, and stays as it was when anything fails.
/// @throws Error (kBadInput) when the folder does not exist or cannot be written, when the path is a
/// directory or a device, or the disk is full. Thread class: set-up.
void write_atomically(const std::string& path, std::string_view bytes);

/// One of several files to write.
struct NamedText {
  std::string path, text;
};

/// Writes several files that belong together: all are on the disk under temporary names before the first one
/// is renamed, in the order given. A full disk therefore leaves every old file as it was.
/// @throws Error (kBadInput), see write_atomically(). Thread class: set-up.
void write_together(std::span<const NamedText> files);

/// Finds out before a long computation whether write_atomically() can work; writes nothing.
/// @throws Error (kBadInput), the same as write_atomically(). Thread class: set-up.
void check_can_write(const std::string& path);

/// What is read is never replaced by what is made of it. @param input an existing file or not, by any name
/// @param cure which option to change. @throws Error (kUsage). Thread class: set-up.
void check_input_survives(const std::string& output, const std::string& input, const std::string& cure);

}  // namespace fuai
