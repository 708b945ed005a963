// Reads recordings line by line.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/io/text_file.h"
#include "fuai/viewer/view_log.h"
#include "fuai/viewer/view_log_words.h"

namespace fuai {
namespace {

constexpr std::uint64_t kLargestRecording = std::uint64_t{1} << 30;  // a day of dragging

/// One line, taken apart word by word.
class Line {
 public:
  Line(std::string_view text, const std::string& file, int number)
      : rest_(text), file_(&file), number_(number) {}

  [[noreturn]] void refuse(const std::string& what, const std::string& cure = {}) const {
    throw Error(ErrorKind::kBadInput, what, {*file_, number_, 0, {}}, cure);
  }
  bool empty() const { return rest_.empty(); }
  /// Another text in the same place.
  Line with(std::string_view text) const { return {text, *file_, number_}; }
  std::string_view rest() { return std::exchange(rest_, {}); }

  std::string_view word() {
    const std::size_t length = std::min(rest_.find(' '), rest_.size());
    if (length == 0) refuse("the line is too short");
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    return word;
  }

  template <class T>
  T number(T least, T most) {
    const std::string_view text = word();
    T value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size())
      refuse("'" + std::string(text) + "' is not a number of the right kind");
    if (!(value >= least && value <= most)) refuse("the number " + std::string(text) + " is out of range");
    return value;
  }
  /// A length that some cloth could have [m], or a factor.
  double real() { return number(-1e6, 1e6); }
  Vec3 vector() {
    const double x = real(), y = real();
    return {x, y, real()};
  }
  bool flag() { return number(0, 1) == 1; }
  std::uint64_t hash() {
    const std::string_view text = word();
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (code != std::errc() || end != text.data() + text.size() || text.size() != 16)
      refuse("'" + std::string(text) + "' is not a hash", "a hash has 16 hexadecimal digits");
    return value;
  }
  void end() const {
    if (!empty()) refuse("the line goes on with '" + std::string(rest_) + "'");
  }

 private:
  std::string_view rest_;
  const std::string* file_;
  int number_;
};

std::string unescaped(Line& line) {
  const std::string_view text = line.rest();
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      name += text[i];
      continue;
    }
    unsigned byte = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16).ptr != digits.data() + 2)
      line.refuse("a percent sign must be followed by two hexadecimal digits");
    name += static_cast<char>(byte);
    i += 2;
  }
  return name;
}

ViewFabric read_fabric(Line& line) {
  ViewFabric fabric;
  const std::uint64_t recorded = line.hash();
  for (double& factor : fabric.factors) factor = line.number(kLeastFactor, kMostFactor);
  const std::string source = unescaped(line);
  if (source.empty()) line.refuse("the fabric has no name");
  const auto factors = fabric.factors;
  fabric = load_view_fabric(source);
  fabric.factors = factors;
  if (laws_hash(make_view_laws(fabric)) != recorded) {
    line.refuse("the fabric '" + fabric.source + "' is not what it was when this was recorded",
                "bring back the fabric file of then; a recording holds its name, not its numbers");
  }
  return fabric;
}

ViewCommand read_command(Line& line, ViewCommand::Kind kind) {
  using Kind = ViewCommand::Kind;
  ViewCommand command;
  command.kind = kind;
  if (kind == Kind::kGrab || kind == Kind::kMove || kind == Kind::kRelease)
    command.hand = static_cast<std::uint8_t>(line.number<int>(0, static_cast<int>(kMostViewHands) - 1));
  if (kind == Kind::kGrab) {
    const double weft = line.real();
    command.material = {weft, line.real()};
  }
  if (kind == Kind::kGrab || kind == Kind::kMove) command.position = line.vector();
  if (kind == Kind::kGrab) {
    command.radius = line.number(0.0, kMostPatchRadius);
    if (!line.empty()) command.stiffness = line.number(kLeastHoldStiffness, kMostHoldStiffness);
  }
  if (kind == Kind::kMove) command.ticks = static_cast<std::uint16_t>(line.number<int>(0, 0xffff));
  if (kind == Kind::kMotion) command.flag = line.flag();
  return command;
}

/// Gathers parts line by line.
class Reader {
 public:
  void take(Line line) {
    const std::string first(line.word());
    if (in_head_) return take_head(first, line);
    if (first == view_log::kPart) return take_part(line);
    if (parts_.empty()) line.refuse("there is no setup yet", "a recording begins with a part");
    if (first == view_log::kRewind) return take_rewind(line);
    take_event(first, line);
  }

  std::vector<ViewLogPart> parts() && {
    // A setup that was torn off never came into force.
    if (in_head_) parts_.pop_back();
    return std::move(parts_);
  }

 private:
  void take_part(Line& line) {
    ViewLogPart part;
    part.tick = line.number<std::int64_t>(last_tick_, kMostTick);
    const std::string_view how = line.word();
    if (how != "kept" && how != "anew") line.refuse("a part is 'kept' or 'anew'");
    part.keep_shape = how == "kept";
    line.end();
    last_tick_ = part.tick;
    parts_.push_back(std::move(part));
    in_head_ = true;
  }

  void take_head(const std::string& first, Line& line) {
    ViewSetup& setup = parts_.back().setup;
    if (first == view_log::kScene) {
      setup.scene = line.word();
    } else if (first == view_log::kSize) {
      setup.size.size = line.number(0, kMostSceneSize);
      setup.size.spacing = line.number(0.0, kMostSceneSpacing);
    } else if (first == view_log::kMoves) {
      setup.scene_moves = line.flag();
    } else if (first == view_log::kFelt) {
      setup.felt = line.flag();
    } else if (first == view_log::kFabric) {
      setup.fabrics.push_back(read_fabric(line));
    } else if (first == view_log::kBegin) {
      if (setup.fabrics.empty()) line.refuse("the setup has no fabric");
      in_head_ = false;
    } else {
      line.refuse("a setup has no '" + first + "'");
    }
    line.end();
  }

  void take_rewind(Line& line) {
    const auto to = line.number<std::int64_t>(parts_.back().tick + 1, kMostTick);
    line.end();
    std::erase_if(parts_.back().events, [&](const ViewEvent& event) { return event.tick >= to; });
    last_tick_ = parts_.back().events.empty() ? parts_.back().tick : parts_.back().events.back().tick;
  }

  void take_event(const std::string& first, Line& line) {
    ViewEvent event;
    Line number = line.with(first);
    event.tick = number.number<std::int64_t>(last_tick_, kMostTick);
    const std::string_view word = line.word();
    const auto* known = std::ranges::find(view_log::kCommandWords, word, &view_log::CommandWord::word);
    if (word == view_log::kHash) {
      event.kind = ViewEvent::Kind::kHash;
      event.hash = line.hash();
    } else if (known != view_log::kCommandWords.end()) {
      event.command = read_command(line, known->kind);
    } else {
      line.refuse("there is no event '" + std::string(word) + "'");
    }
    line.end();
    last_tick_ = event.tick;
    parts_.back().events.push_back(event);
  }

  static constexpr std::int64_t kMostTick = (std::int64_t{1} << 31) - 1;  // what single_steps() takes
  std::vector<ViewLogPart> parts_;
  bool in_head_ = false;
  std::int64_t last_tick_ = 0;
};

}  // namespace

std::vector<ViewLogPart> read_view_log(const std::string& path) {
  const std::string bytes = read_bytes(path, kLargestRecording);
  Reader reader;
  std::string_view left = bytes;
  for (int number = 1; !left.empty(); ++number) {
    const std::size_t end = left.find('\n');
    if (end == std::string_view::npos) break;  // torn
    Line line(left.substr(0, end), path, number);
    left.remove_prefix(end + 1);
    if (number > 1) {
      reader.take(line);
    } else if (line.rest() != view_log::kFormat) {
      line.refuse("this is not a recording of the viewer",
                  "its first line is " + std::string(view_log::kFormat));
    }
  }
  std::vector<ViewLogPart> parts = std::move(reader).parts();
  if (parts.empty())
    throw Error(ErrorKind::kBadInput, "the recording ends before it begins", {path, 0, 0, {}});
  return parts;
}

}  // namespace fuai
