#include "app/trials/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>

#include "engine/text/files/file.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

constexpr std::string_view kHeading = "weft passes 2";

using Key = std::pair<std::string_view, std::string_view>;
Key keyOf(const runtime::StepRecord& step) {
  return {step.pass, step.resource};
}

bool readHex(std::string_view text, std::uint64_t& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
  return error == std::errc{} && end == text.data() + text.size();
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');) fields.push_back(std::move(field));
  return fields;
}

// A line of a record: "frame 0", or a pass.
bool readLine(const std::string& line, PassRecords& records) {
  if (line.starts_with("frame ")) {
    std::uint32_t& frame = records.frames.emplace_back().frame;
    const auto [end, error] = std::from_chars(line.data() + 6, line.data() + line.size(), frame);
    return error == std::errc{} && end == line.data() + line.size();
  }
  const std::vector<std::string> fields = split(line);
  if (fields.size() != 3 || records.frames.empty()) return false;
  runtime::StepRecord& step = records.frames.back().steps.emplace_back();
  step.pass = fields[1];
  step.resource = fields[2];
  return readHex(fields[0], step.hash);
}

std::optional<Divergence> compareFrames(const FrameRecord& before, const FrameRecord& after, bool exact,
                                        const std::vector<std::string>& culled,
                                        std::optional<Divergence>& follower) {
  std::map<Key, std::size_t> old, fresh;
  for (std::size_t i = 0; i < before.steps.size(); ++i) old[keyOf(before.steps[i])] = i;
  for (std::size_t i = 0; i < after.steps.size(); ++i) fresh[keyOf(after.steps[i])] = i;
  const auto found = [&](Divergence::Kind kind, const runtime::StepRecord& step) {
    return Divergence{kind, after.frame, step.pass, step.resource};
  };
  std::size_t passed = 0;  // of `before`
  const auto goOnTo = [&](std::size_t end) -> std::optional<Divergence> {
    for (; passed < end; ++passed) {
      if (fresh.contains(keyOf(before.steps[passed]))) continue;
      auto missing = found(Divergence::Kind::missing, before.steps[passed]);
      if (std::ranges::find(culled, missing.pass) == culled.end()) return missing;
      if (!follower) follower = std::move(missing);
    }
    return std::nullopt;
  };
  for (const runtime::StepRecord& step : after.steps) {
    const auto known = old.find(keyOf(step));
    if (known == old.end()) return found(Divergence::Kind::added, step);
    if (auto missing = goOnTo(known->second)) return missing;
    if (exact && before.steps[known->second].hash != step.hash) return found(Divergence::Kind::differs, step);
  }
  return goOnTo(before.steps.size());
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
  std::istringstream in(*text);
  std::uint32_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (number == 2 && line.starts_with("driver ")) records.driver = line.substr(7);
    const bool good = number == 1   ? line == kHeading
                      : number == 2 ? line.starts_with("driver ")
                                    : readLine(line, records);
    if (good) continue;
    diagnostics.error(
        text::Code::wrongType, {path, number, 1}, "this is no line of a record of passes",
        {.found = text::shortened(text::printable(line)), .hint = "write the file anew: weft test --accept"});
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
