#include "app/trials/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "app_sentences.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

constexpr std::string_view kHeading = "weft passes 2";

// "weft passes 2", "driver …"; then "frame 0", and below it a line for each pass.
bool takeRecord(std::string_view line, std::uint32_t number, PassRecords& records) {
  if (number == 1) return line == kHeading;
  const std::size_t space = line.find(' ');
  if (number == 2) {
    records.driver = line.substr(std::min(space + 1, line.size()));
    return line.starts_with("driver ");
  }
  if (line.starts_with("frame ")) {
    const auto frame = text::numberIn<std::uint32_t>(line.substr(space + 1));
    records.frames.push_back({frame.value_or(0), {}});
    return frame.has_value();
  }
  if (records.frames.empty()) return false;
  runtime::StepRecord& step = records.frames.back().steps.emplace_back();
  std::istringstream fields{std::string(line)};
  return (fields >> std::hex >> step.hash >> step.pass >> step.resource) && fields.eof();
}

std::optional<Divergence> compareFrames(const FrameRecord& before, const FrameRecord& after, bool exact,
                                        const std::vector<std::string>& culled,
                                        std::optional<Divergence>& follower) {
  using Kind = Divergence::Kind;
  const auto same = [](const FrameRecord& frame, const runtime::StepRecord& step) {
    return std::ranges::find_if(frame.steps, [&](const runtime::StepRecord& each) {
      return each.pass == step.pass && each.resource == step.resource;
    });
  };
  const auto found = [&](Kind kind, const runtime::StepRecord& step) {
    return Divergence{kind, after.frame, step.pass, step.resource};
  };
  auto passed = before.steps.begin();
  const auto goOnTo = [&](auto end) -> std::optional<Divergence> {
    for (; passed < end; ++passed) {
      if (same(after, *passed) != after.steps.end()) continue;
      auto missing = found(Kind::missing, *passed);
      if (std::ranges::find(culled, missing.pass) == culled.end()) return missing;
      if (!follower) follower = std::move(missing);
    }
    return std::nullopt;
  };
  for (const runtime::StepRecord& step : after.steps) {
    const auto known = same(before, step);
    if (known == before.steps.end()) return found(Kind::added, step);
    if (auto missing = goOnTo(known)) return missing;
    if (exact && known->hash != step.hash) return found(Kind::differs, step);
  }
  return goOnTo(before.steps.end());
}

}  // namespace

std::string Divergence::text() const {
  if (kind == Kind::added)
    return fmt::format("pass '{}' writes '{}' in frame {}, which it did not", pass, resource, frame);
  if (kind == Kind::missing)
    return fmt::format("pass '{}' no longer writes '{}' in frame {}", pass, resource, frame);
  return fmt::format("pass '{}' writes another '{}' in frame {}", pass, resource, frame);
}

std::string toText(const PassRecords& records) {
  std::string text = fmt::format("{}\ndriver {}\n", kHeading, records.driver);
  for (const FrameRecord& frame : records.frames) {
    text += fmt::format("frame {}\n", frame.frame);
    for (const runtime::StepRecord& step : frame.steps)
      text += fmt::format("{:016x}\t{}\t{}\n", step.hash, step.pass, step.resource);
  }
  return text;
}

std::optional<PassRecords> readRecords(const std::string& path, text::Diagnostics& diagnostics) {
  const auto text = text::readFile(path, diagnostics);
  if (!text) return std::nullopt;
  PassRecords records;
  std::string_view rest = *text;
  for (std::uint32_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = text::takeLine(rest);
    if (takeRecord(line, number, records)) continue;
    diagnostics.error(say::noRecordLine, {path, number, 1}, text::shortened(text::printable(line)));
    return std::nullopt;
  }
  return records;
}

std::optional<Divergence> findDivergence(const PassRecords& before, const PassRecords& after) {
  const bool exact = before.driver == after.driver;
  std::optional<Divergence> follower;
  for (const FrameRecord& frame : after.frames) {
    const auto same = std::ranges::find(before.frames, frame.frame, &FrameRecord::frame);
    if (same == before.frames.end()) continue;
    if (auto found = compareFrames(*same, frame, exact, after.culled, follower)) return found;
  }
  return follower;
}

}  // namespace weft::app
