#include "app/trials/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

#include "engine/assets/images/half.h"
#include "engine/base/files/file.h"
#include "engine/base/printable.h"

namespace weft::app {

namespace {

constexpr std::string_view kHeading = "weft passes 1";

using Key = std::pair<std::string_view, std::string_view>;
Key keyOf(const runtime::StepRecord& step) {
  return {step.pass, step.resource};
}

template <class Signature, class Visit>
void forEachNumber(Signature& signature, Visit&& visit) {
  for (auto& part : signature.parts) visit(part);
  for (auto& channel : signature.channels) visit(channel);
  visit(signature.broken);
}

std::string signatureText(const std::optional<runtime::Signature>& signature) {
  if (!signature) return "-";
  std::string text;
  forEachNumber(*signature, [&](float value) {
    text +=
        fmt::format("{:04x}", assets::floatToHalf(std::clamp(value, -assets::kHalfMax, assets::kHalfMax)));
  });
  return text;
}

bool readHex(std::string_view text, std::uint64_t& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out, 16);
  return error == std::errc{} && end == text.data() + text.size();
}

bool readSignature(std::string_view text, std::optional<runtime::Signature>& out) {
  if (text == "-") return true;
  out.emplace();
  bool good = true;
  forEachNumber(*out, [&](float& value) {
    std::uint64_t half = 0;
    good = good && text.size() >= 4 && readHex(text.substr(0, 4), half);
    if (!good) return;
    value = assets::halfToFloat(static_cast<std::uint16_t>(half));
    text.remove_prefix(4);
  });
  return good && text.empty();
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find('\t', at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return fields;
}

// A line of a record: "frame 0", or a pass.
bool readLine(std::string_view line, PassRecords& records) {
  if (line.starts_with("frame ")) {
    std::uint32_t frame = 0;
    const auto [end, error] = std::from_chars(line.data() + 6, line.data() + line.size(), frame);
    if (error != std::errc{} || end != line.data() + line.size()) return false;
    records.frames.push_back({frame, {}});
    return true;
  }
  const std::vector<std::string_view> fields = split(line);
  if (fields.size() != 4 || records.frames.empty()) return false;
  runtime::StepRecord step{.pass = std::string(fields[2]), .resource = std::string(fields[3])};
  if (!readHex(fields[0], step.hash) || !readSignature(fields[1], step.signature)) return false;
  records.frames.back().steps.push_back(std::move(step));
  return true;
}

std::optional<Divergence> compareFrames(const FrameRecord& before, const FrameRecord& after, bool exact,
                                        const std::vector<std::string>& culled,
                                        std::optional<Divergence>& follower) {
  std::map<Key, std::size_t> old, fresh;
  for (std::size_t i = 0; i < before.steps.size(); ++i) old[keyOf(before.steps[i])] = i;
  for (std::size_t i = 0; i < after.steps.size(); ++i) fresh[keyOf(after.steps[i])] = i;
  const auto found = [&](Divergence::Kind kind, const runtime::StepRecord& step, double amount) {
    return Divergence{kind, after.frame, step.pass, step.resource, amount, exact};
  };
  std::size_t passed = 0;  // of `before`
  const auto goOnTo = [&](std::size_t end) -> std::optional<Divergence> {
    for (; passed < end; ++passed) {
      if (fresh.contains(keyOf(before.steps[passed]))) continue;
      auto missing = found(Divergence::Kind::missing, before.steps[passed], 0);
      if (std::ranges::find(culled, missing.pass) == culled.end()) return missing;
      if (!follower) follower = std::move(missing);
    }
    return std::nullopt;
  };
  for (const runtime::StepRecord& step : after.steps) {
    const auto known = old.find(keyOf(step));
    if (known == old.end()) return found(Divergence::Kind::added, step, 0);
    if (auto missing = goOnTo(known->second)) return missing;
    const runtime::StepRecord& golden = before.steps[known->second];
    const bool both = golden.signature && step.signature;
    const double amount = both ? runtime::differenceOf(*golden.signature, *step.signature) : 0;
    if (exact ? golden.hash != step.hash : amount > kSignatureNoise)
      return found(Divergence::Kind::differs, step, amount);
  }
  return goOnTo(before.steps.size());
}

}  // namespace

std::string Divergence::text() const {
  if (kind == Kind::added)
    return fmt::format("pass '{}' writes '{}' in frame {}, which it did not", pass, resource, frame);
  if (kind == Kind::missing)
    return fmt::format("pass '{}' no longer writes '{}' in frame {}", pass, resource, frame);
  const std::string much = amount >= 0.002 ? fmt::format(" (by {:.2g} % of a part of it)", 100 * amount)
                           : exact         ? " (in single texels)"
                                           : "";
  return fmt::format("pass '{}' writes another '{}' in frame {}{}", pass, resource, frame, much);
}

PassRecords recordsOf(const Shot& shot, std::string driver) {
  PassRecords records{std::move(driver), shot.records, {}};
  for (std::size_t pass = 0; pass < shot.plan->stepOf.size(); ++pass)
    if (shot.plan->stepOf[pass] == graph::kNone) records.culled.push_back(shot.plan->graph->passNames[pass]);
  return records;
}

std::string toText(const PassRecords& records) {
  std::string text = fmt::format("{}\ndriver {}\n", kHeading, records.driver);
  for (const FrameRecord& frame : records.frames) {
    text += fmt::format("frame {}\n", frame.frame);
    for (const runtime::StepRecord& step : frame.steps)
      text += fmt::format("{:016x}\t{}\t{}\t{}\n", step.hash, signatureText(step.signature), step.pass,
                          step.resource);
  }
  return text;
}

std::optional<PassRecords> readRecords(const std::string& path, base::Diagnostics& diagnostics) {
  const auto text = base::readFile(path, diagnostics);
  if (!text) return std::nullopt;
  PassRecords records;
  std::string_view rest = *text;
  const auto file = std::make_shared<const std::string>(path);
  for (std::uint32_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    bool good = false;
    if (number == 1) {
      good = line == kHeading;
    } else if (number == 2 && line.starts_with("driver ")) {
      records.driver = line.substr(7);
      good = true;
    } else {
      good = number > 2 && readLine(line, records);
    }
    if (good) continue;
    base::Diagnostic& d =
        diagnostics.error(base::Code::wrongType, {file, number, 1}, "this is no line of a record of passes");
    d.found = base::shortened(base::printable(line));
    d.hint = "write the file anew: weft test --accept";
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
