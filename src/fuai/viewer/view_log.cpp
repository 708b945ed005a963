// Writes recordings and runs them again.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_log.h"

#include <algorithm>
#include <map>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/io/growing_file.h"
#include "fuai/io/number_text.h"
#include "fuai/viewer/view_log_words.h"

namespace fuai {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += " " + number_text(value);
  return text;
}

std::string numbers(const Vec3& v) { return numbers({v.x(), v.y(), v.z()}); }

/// A name on one line: control characters and the percent sign as %XX.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && c != '%') {
      text += c;
    } else {
      constexpr const char* kDigits = "0123456789abcdef";
      text += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
  }
  return text;
}

std::string setup_text(std::int64_t tick, const ViewSetup& setup, bool keep_shape) {
  std::string text =
      std::string(view_log::kPart) + " " + std::to_string(tick) + (keep_shape ? " kept" : " anew") + "\n";
  text += std::string(view_log::kScene) + " " + setup.scene + "\n";
  text += std::string(view_log::kSize) + " " + std::to_string(setup.size.size) +
          numbers({setup.size.spacing}) + "\n";
  text += std::string(view_log::kMoves) + (setup.scene_moves ? " 1\n" : " 0\n");
  // Only where it is so: a recording without a device stays what earlier versions write and read.
  if (setup.felt) text += std::string(view_log::kFelt) + " 1\n";
  for (const ViewFabric& fabric : setup.fabrics) {
    text += std::string(view_log::kFabric) + " " + hash_text(laws_hash(make_view_laws(fabric)));
    for (const double factor : fabric.factors) text += numbers({factor});
    text += " " + escaped(fabric.source) + "\n";
  }
  return text + std::string(view_log::kBegin) + "\n";
}

std::string event_text(const ViewEvent& event) {
  using Kind = ViewCommand::Kind;
  std::string text = std::to_string(event.tick);
  if (event.kind == ViewEvent::Kind::kHash)
    return text + " " + std::string(view_log::kHash) + " " + hash_text(event.hash) + "\n";
  const ViewCommand& c = event.command;
  text += " " + std::string(view_log::word_of(c.kind));
  const std::string hand = " " + std::to_string(c.hand);
  switch (c.kind) {
    case Kind::kGrab:
      text += hand + numbers({c.material.x(), c.material.y()}) + numbers(c.position) + numbers({c.radius});
      if (c.stiffness != GraspSpec{}.stiffness) text += numbers({c.stiffness});
      break;
    case Kind::kMove:
      text += hand + numbers(c.position) + " " + std::to_string(c.ticks);
      break;
    case Kind::kRelease:
      text += hand;
      break;
    case Kind::kReset:
      break;
    case Kind::kMotion:
      text += c.flag ? " 1" : " 0";
      break;
  }
  return text + "\n";
}

}  // namespace

struct ViewLogWriter::Parts {
  GrowingFile file;
  ViewSetup setup{};  ///< in force
  std::map<std::uint64_t, ViewSetup> announced{};
  bool began = false;
  std::int64_t part_tick = 0;

  std::string part(std::int64_t tick, bool keep_shape) {
    began = true;
    part_tick = tick;
    return setup_text(tick, setup, keep_shape);
  }
  std::string replaced(const ViewEvent& event);
};

/// Other cloths: the setup is in force from here on, and a recording that waits for a start has one.
std::string ViewLogWriter::Parts::replaced(const ViewEvent& event) {
  const auto found = announced.find(event.build);
  if (found == announced.end()) {
    if (!began) return {};  // from before this recording
    throw Error(ErrorKind::kUsage, "a recording was not told of a change of cloths");
  }
  setup = found->second;
  announced.erase(announced.begin(), std::next(found));  // earlier ones were passed over
  if (!began && event.kept_shape) return {};
  return part(event.tick, event.kept_shape);
}

ViewLogWriter::ViewLogWriter(const std::string& path, const ViewSetup& setup)
    : parts_(new Parts{GrowingFile(path), setup}) {
  parts_->file.add(std::string(view_log::kFormat) + "\n");
}

ViewLogWriter::~ViewLogWriter() = default;

void ViewLogWriter::announce(std::uint64_t build, const ViewSetup& setup) {
  parts_->announced.insert_or_assign(build, setup);
}

bool ViewLogWriter::begun() const noexcept { return parts_->began; }

void ViewLogWriter::write(const std::vector<ViewEvent>& events, std::int64_t rewound_to) {
  Parts& p = *parts_;
  std::string text;
  if (p.began && rewound_to >= 0 && rewound_to <= p.part_tick)
    throw Error(ErrorKind::kUsage, "the beginning of the recording was taken back", {},
                "begin it with replace()");
  if (p.began && rewound_to > p.part_tick)
    text += std::string(view_log::kRewind) + " " + std::to_string(rewound_to) + "\n";
  for (const ViewEvent& event : events) {
    if (event.kind == ViewEvent::Kind::kReplaced) {
      text += p.replaced(event);
    } else if (p.began) {
      text += event_text(event);
    } else if (event.kind == ViewEvent::Kind::kHash && event.tick == 0) {
      text += p.part(0, false) + event_text(event);
    } else if (event.kind == ViewEvent::Kind::kCommand && event.command.kind == ViewCommand::Kind::kReset) {
      text += p.part(event.tick, false);  // the same as a fresh start
    }
  }
  if (!text.empty()) p.file.add(text);
}

ViewScript view_script(const std::vector<ViewLogPart>& parts, std::size_t part) {
  ViewScript script;
  script.first_tick = script.last_tick = parts[part].tick;
  script.events = parts[part].events;
  script.more = part + 1 < parts.size();
  if (!script.events.empty()) script.last_tick = script.events.back().tick;
  if (script.more) script.last_tick = parts[part + 1].tick;
  return script;
}

ViewReplay replay_view_log(const std::vector<ViewLogPart>& parts) {
  ViewReplay replay;
  if (parts.empty()) return replay;
  ViewSession session(std::make_shared<ViewCloths>(parts.front().setup));
  const std::int64_t base = parts.front().tick;
  const auto run_to = [&](std::int64_t tick) {
    const std::int64_t wanted = tick - base;
    session.single_steps(static_cast<int>(wanted - session.ticks()));
    while (session.ticks() < wanted) session.tick(0.0);
  };
  for (const ViewLogPart& part : parts) {
    run_to(part.tick);
    if (&part != &parts.front()) {
      session.replace(std::make_shared<ViewCloths>(part.setup), part.keep_shape);
      session.tick(0.0);
    }
    for (const ViewEvent& event : part.events) {
      run_to(event.tick);
      if (event.kind == ViewEvent::Kind::kCommand) {
        session.send(event.command);
        session.tick(0.0);
        continue;
      }
      replay.state_hash = session.state_hash();
      replay.recorded_hash = event.hash;
      ++replay.hashes;
      if (replay.state_hash != replay.recorded_hash && replay.first_difference < 0)
        replay.first_difference = event.tick;
    }
  }
  replay.ticks = session.ticks();
  session.tick(1e6);  // paused: a snapshot, and no step
  session.fetch();
  const std::vector<ClothView>& cloths = session.snapshot().cloths;
  for (std::size_t c = 0; c < cloths.size(); ++c)
    for (std::size_t h = 0; h < kMostViewHands; ++h)
      if (cloths[c].hands[h].holds) replay.forces.push_back({c, h, cloths[c].hands[h].force.norm()});
  return replay;
}

}  // namespace fuai
