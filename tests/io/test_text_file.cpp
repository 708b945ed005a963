// Reading text whole, decoding it, and writing files whole or not at all.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "fuai/io/text_file.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

namespace {

std::string message_of(const std::string& path) {
  return error_of([&] { read_text_file(path); }).what();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("each unreadable path has its own message with the path in it") {
    const TemporaryFolder folder;
    CHECK(message_of(folder / "none.csv") ==
          (folder / "none.csv") + ": the file does not exist; check the path");
    CHECK(contains(message_of(folder.path()), "this is a directory, not a file"));
    CHECK(contains(message_of(folder.write("empty.csv", "")), "the file is empty"));
    CHECK(contains(message_of(folder.write("bom.csv", "\xEF\xBB\xBF")), "the file is empty"));
    CHECK(contains(message_of("/dev/zero"), "not a regular file"));
    // A link that leads to itself cannot be opened, by root neither.
    std::filesystem::create_symlink("loop", folder / "loop");
    CHECK(contains(message_of(folder / "loop"), "cannot be opened"));
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(contains(message_of(folder / "pipe"), "not a regular file"));
  }

  TEST_CASE("a 2 GB file is refused by its size") {
    const TemporaryFolder folder;
    const std::string path = folder.write("huge.csv", "x");
    std::filesystem::resize_file(path, 2ULL << 30);  // sparse: occupies no disk
    CHECK(contains(message_of(path), "2147483648 bytes, more than the limit of 67108864"));
    const std::string small = folder.write("small.csv", "12345");
    CHECK(read_text_file(small, 5) == "12345");
    CHECK_THROWS_AS(read_text_file(small, 4), Error);
  }

  TEST_CASE("encodings: UTF-8 with and without byte order mark, CP932") {
    CHECK(decode_text("\xEF\xBB\xBFtext", "f") == "text");
    CHECK(decode_text("曲げ剛性", "f") == "曲げ剛性");
    CHECK(decode_text("\x8B\xC8\x82\xB0\x8D\x84\x90\xAB", "f") == "曲げ剛性");
    CHECK(decode_text("\xB6\xC4", "f") == "ｶﾄ");
    CHECK(decode_text("\xF0\x9F\x98\x80", "f") == "\xF0\x9F\x98\x80");
  }

  TEST_CASE("bytes that are neither encoding are refused with their place") {
    const Error error = error_of([] { decode_text("ab\ncd\x81", "f.csv"); });
    CHECK(contains(error.what(), "f.csv:2:3: the text is neither UTF-8 nor CP932"));
    // Not UTF-8: overlong, surrogate, beyond U+10FFFF; none of them is CP932 either.
    for (const char* bytes : {"\xC0\xAF\xFF", "\xED\xA0\x80\xFF", "\xF5\x80\x80\x80\xFF"}) {
      CHECK_THROWS_AS(decode_text(bytes, "f"), Error);
    }
  }

  TEST_CASE("binary files are refused") {
    CHECK(contains(error_of([] { decode_text(std::string("a\nb\0c", 5), "f"); }).what(),
                   "f:2:2: there is a NUL"));
    CHECK(contains(error_of([] {
                     decode_text(std::string("\xFF\xFE"
                                             "a\0",
                                             4),
                                 "f");
                   }).what(),
                   "UTF-16"));
  }

  TEST_CASE("line ends become line feeds") { CHECK(decode_text("a\r\nb\rc\n\r\n", "f") == "a\nb\nc\n\n"); }

  TEST_CASE("a file is written whole, replaces the old one and keeps its permissions") {
    const TemporaryFolder folder;
    const std::string path = folder / "out.toml";
    write_atomically(path, "one");
    CHECK(read_text_file(path) == "one");
    std::filesystem::permissions(path,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    write_atomically(path, std::string(100000, 'x'));
    CHECK(read_text_file(path) == std::string(100000, 'x'));
    CHECK(std::filesystem::status(path).permissions() ==
          (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write));
    CHECK(folder.entry_count() == 1);  // no temporary file is left
  }

  TEST_CASE("a link is followed, not replaced") {
    const TemporaryFolder folder;
    folder.write("real.toml", "old");
    std::filesystem::create_symlink("real.toml", folder / "link.toml");
    write_atomically(folder / "link.toml", "new");
    CHECK(std::filesystem::is_symlink(folder / "link.toml"));
    CHECK(read_text_file(folder / "real.toml") == "new");
  }

  TEST_CASE("places that cannot be written are refused and nothing is left") {
    const TemporaryFolder folder;
    const auto message = [](const std::string& path) {
      return std::string(error_of([&] { write_atomically(path, "x"); }).what());
    };
    CHECK(contains(message(folder / "no/such/out.toml"), "does not exist"));
    CHECK(contains(message(folder.path()), "this is a directory"));
    CHECK(contains(message("/dev/null"), "not a regular file"));
    CHECK(contains(message(folder / std::string(300, 'x')), "cannot write into the folder"));
    CHECK(contains(message(""), "is empty"));
    CHECK(folder.entry_count() == 0);
  }

  TEST_CASE("files written together: none is new when one of them cannot be written") {
    const TemporaryFolder folder;
    folder.write("a.csv", "old");
    const std::vector<NamedText> bad{{folder / "a.csv", "new"}, {folder / "none/b.csv", "new"}};
    CHECK(contains(error_of([&] { write_together(bad); }).what(), "does not exist"));
    CHECK(read_text_file(folder / "a.csv") == "old");
    CHECK(folder.entry_count() == 1);
    const std::vector<NamedText> good{{folder / "a.csv", "new"}, {folder / "b.csv", "second"}};
    write_together(good);
    CHECK(read_text_file(folder / "a.csv") == "new");
    CHECK(read_text_file(folder / "b.csv") == "second");
    CHECK(folder.entry_count() == 2);
  }

  TEST_CASE("a place is examined before a long computation, and nothing is written") {
    const TemporaryFolder folder;
    check_can_write(folder / "out.png");
    CHECK(folder.entry_count() == 0);
    CHECK(contains(error_of([&] { check_can_write(folder.path()); }).what(), "this is a directory"));
    CHECK(contains(error_of([&] { check_can_write(folder / "no/out.png"); }).what(), "does not exist"));
  }
}
