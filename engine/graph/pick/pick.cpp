#include "engine/graph/pick/pick.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>
#include <unordered_set>

#include "engine/graph/language/names.h"
#include "engine/graph/subresource.h"
#include "engine/text/chars.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using text::Code;

template <class... Args>
bool reportPick(text::Diagnostics& diagnostics, const Pick& pick, text::Saying<Args...> what,
                Args&&... args) {
  const std::string option = pick.option + (pick.option.empty() ? "" : " ") + pick.text;
  diagnostics.error<Args...>(what, text::placeOfOption(option), std::forward<Args>(args)...).resource =
      pick.name;
  return false;
}

// Which version of its name a resource is, from 1.
std::uint32_t versionOf(std::string_view resourceName) {
  const std::size_t at = resourceName.find('#');
  return at == std::string_view::npos
             ? 1
             : static_cast<std::uint32_t>(std::stoul(std::string(resourceName.substr(at + 1))));
}

std::uint32_t findVersion(const FlatGraph& graph, const Pick& pick, text::Diagnostics& diagnostics) {
  std::vector<std::string> names;  // each once
  std::unordered_set<std::string_view> known;
  for (const std::string& name : graph.resourceNames)
    if (const std::string_view shared = sharedName(name); known.insert(shared).second)
      names.emplace_back(shared);
  constexpr const char* kPathHint = "a path with = in it is written ./a=b.png";
  if (!parsePick(pick.text)) {
    const std::string near = suffixHint(pick.text.substr(0, pick.text.find_first_of(".#[@ ")), names);
    reportPick(diagnostics, pick, say::cannotNameResource, pick.text,
               near + (near.empty() ? "" : "; ") + kPathHint);
    return kNone;
  }
  const std::vector<std::size_t> matches = suffixMatches(names, pick.name);
  if (matches.size() != 1) {
    std::string hint = suffixHint(pick.name, names);
    if (hint.empty() && pick.option == "-o") hint = kPathHint;
    matches.empty() ? reportPick(diagnostics, pick, say::noPassUses, pick.name, hint)
                    : reportPick(diagnostics, pick, say::ambiguousResource, pick.name, matches.size(),
                                 names[matches[0]], names[matches[1]]);
    return kNone;
  }
  std::uint32_t found = kNone, last = 0;
  for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
    if (sharedName(graph.resourceNames[r]) != names[matches[0]]) continue;
    const std::uint32_t version = versionOf(graph.resourceNames[r]);
    if (pick.version == 0 ? version > last : version == pick.version) found = r;
    last = std::max(last, version);
  }
  if (found == kNone) reportPick(diagnostics, pick, say::hasNoVersion, pick.name, pick.version, last);
  return found;
}

bool checkParts(const FlatResource& resource, const Pick& pick, text::Diagnostics& diagnostics) {
  const std::uint32_t slices = slicesOf(resource, pick.mip);
  if (pick.mip >= resource.mips)
    return reportPick(diagnostics, pick, say::hasNoLevel, pick.name, pick.mip, resource.mips - 1);
  if (pick.layer >= slices)
    return reportPick(diagnostics, pick, say::hasNoLayer, pick.name, pick.layer, slices - 1);
  if (pick.history > resource.history)
    return reportPick(diagnostics, pick, say::hasNoPublication, pick.name, pick.history, resource.history);
  return !pick.stencil || hasStencil(resource.format) ||
         reportPick(diagnostics, pick, say::hasNoStencil, pick.name);
}

}  // namespace

std::optional<Pick> parsePick(std::string_view text) {
  constexpr std::size_t kLongest = 1000;
  // The name ends before a word that selects a part.
  static const std::regex kPick(
      R"((@?[A-Za-z_]\w*(?:\.(?!(?:mip|layer|face|stencil|[xyzw])(?!\w))[A-Za-z_]\w*)*(?:\[\d+\])?)(?:#(\d+))?)"
      R"(((?:\.(?:mip|layer|face)\[\d+\]|\.stencil)*)(?:@-(\d+))?(?: after (.+))?)");
  static const std::regex kSelector(R"(\.(\w+)(?:\[(\d+)\])?)");
  const std::string whole(text);
  std::smatch found;
  if (whole.size() > kLongest || !std::regex_match(whole, found, kPick)) return std::nullopt;
  Pick pick{.text = whole, .name = found[1], .pass = found[5]};
  for (const auto& [group, out] : {std::pair(2, &pick.version), std::pair(4, &pick.history)}) {
    if (!found[group].matched) continue;
    const auto number = text::numberIn<std::uint32_t>(found[group].str());
    if (!number || *number == 0) return std::nullopt;
    *out = *number;
  }
  std::uint32_t face = 0, layer = 0;
  bool ofCube = false;
  const std::string selectors = found[3];
  for (std::sregex_iterator each(selectors.begin(), selectors.end(), kSelector), end; each != end; ++each) {
    const std::string word = (*each)[1];
    const auto number = text::numberIn<std::uint32_t>((*each)[2].str());
    pick.stencil = pick.stencil || word == "stencil";
    if (word == "stencil") continue;
    if (!number || (word == "face" && *number > 5) || (word == "layer" && *number > 0xffff))
      return std::nullopt;
    (word == "mip" ? pick.mip : word == "face" ? face : layer) = *number;
    ofCube = ofCube || word == "face";
  }
  pick.layer = ofCube ? layer * 6 + face : layer;
  return pick;
}

bool matchesPattern(std::string_view pattern, std::string_view text) {
  // Whether what was looked at of the pattern matches the first t letters of the text.
  std::vector<char> matches(text.size() + 1, 0);
  matches[0] = 1;
  for (const char c : pattern) {
    if (c == '*') {
      for (std::size_t t = 1; t <= text.size(); ++t) matches[t] |= matches[t - 1];
      continue;
    }
    for (std::size_t t = text.size(); t > 0; --t)
      matches[t] = matches[t - 1] & (c == '?' || c == text[t - 1] ? 1 : 0);
    matches[0] = 0;
  }
  return matches.back() != 0;
}

std::string_view sharedName(std::string_view resourceName) {
  return resourceName.substr(0, resourceName.find('#'));
}

std::optional<FoundPick> findPick(const FlatGraph& graph, const Pick& pick, text::Diagnostics& diagnostics) {
  const std::uint32_t resource = findVersion(graph, pick, diagnostics);
  if (resource == kNone || !checkParts(graph.resources[resource], pick, diagnostics)) return std::nullopt;
  if (pick.pass.empty()) return FoundPick{resource, kNone};
  // Without a version, that which the pass wrote is meant.
  const auto isMeant = [&](std::uint32_t each) {
    return each == resource || (pick.version == 0 && sharedName(graph.resourceNames[each]) ==
                                                         sharedName(graph.resourceNames[resource]));
  };
  std::vector<std::string> writers;
  std::vector<FoundPick> written;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    for (const std::uint32_t u : graph.usesOf(p)) {
      const FlatUse& use = graph.uses[u];
      const FoundPick found{use.resource, p};
      if (use.access == Access::read || !isMeant(use.resource)) continue;
      if (!written.empty() && written.back() == found) continue;
      writers.push_back(graph.passNames[p]);
      written.push_back(found);
    }
  }
  const std::vector<std::size_t> matches = suffixMatches(writers, pick.pass);
  if (matches.size() == 1) {
    const FoundPick found = written[matches[0]];
    if (!checkParts(graph.resources[found.resource], pick, diagnostics)) return std::nullopt;
    return found;
  }
  const std::string name(pick.version == 0 ? sharedName(graph.resourceNames[resource])
                                           : std::string_view(graph.resourceNames[resource]));
  const std::string all = fmt::format("{}", fmt::join(writers, ", "));
  matches.empty() ? reportPick(diagnostics, pick, say::noPassWrites, pick.pass, name, all)
                  : reportPick(diagnostics, pick, say::severalPassesWrite, pick.pass, name, all);
  return std::nullopt;
}

void keepPicks(FlatGraph& graph, std::span<const Pick> picks, text::Diagnostics& diagnostics) {
  for (const Pick& pick : picks) {
    const std::optional<FoundPick> found = findPick(graph, pick, diagnostics);
    if (!found) continue;
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      for (const std::uint32_t u : graph.usesOf(p))
        if (FlatUse& use = graph.uses[u]; use.resource == found->resource && use.access != Access::read)
          use.keep = graph.passes[p].sideEffect = true;
  }
}

}  // namespace weft::graph
