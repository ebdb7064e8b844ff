// Resources that are declared under a misspelt name. Declared in misspelt_keys.h.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "engine/base/nearest.h"
#include "engine/graph/desc_walk.h"
#include "engine/graph/read/misspelt_keys.h"

namespace weft::graph {

namespace {

constexpr std::size_t kShortest = 3;  // shorter names are near to each other by chance
constexpr std::size_t kMaxUnknown =
    64;  // a file with more names that are not there has no slip but another mistake

struct Mentions {
  std::uint32_t count = 0;
  Place first;
};

class NameMender {
 public:
  NameMender(GraphDesc& desc, base::Diagnostics& diagnostics) : desc_(desc), diagnostics_(diagnostics) {}

  void run() {
    for (const PassDesc& pass : desc_.passes)
      for (const SlotDesc& slot : pass.slots) add(slot.ref);
    if (desc_.present) add(*desc_.present);
    std::vector<ResourceDesc*> unused = unmentioned();
    if (unused.empty()) return;
    addAll();
    unused = unmentioned();
    findUnknown();
    if (unused.empty() || unknown_.empty() || unknown_.size() > kMaxUnknown) return;
    std::vector<ResourceDesc> also;
    for (ResourceDesc* resource : unused)
      if (const std::string meant = meantBy(*resource); !meant.empty()) {
        const Mentions& mentions = mentions_.at(meant);
        if (mentions.count > 1) {
          report(*resource, mentions, meant);
        } else {
          // Which of the two is right, only other files know: for them both are there.
          auto& d = diagnostics_.error(base::Code::unknownResource, mentions.first,
                                       fmt::format("the resource '{}' is not there", meant));
          d.resource = meant;
          d.hint = fmt::format("did you mean '{}'?", resource->name);
          ResourceDesc& other = also.emplace_back();
          other.name = resource->name;
          other.place = resource->place;
          other.kind = ResourceDesc::Kind::alternatives;
          RefDesc& ref = other.alternatives.emplace_back();
          ref.text = ref.name = meant;
          ref.place = resource->place;
        }
        resource->name = meant;
        std::erase(unknown_, meant);
      }
    for (ResourceDesc& other : also) desc_.resources.push_back(std::move(other));
  }

 private:
  void report(const ResourceDesc& resource, const Mentions& mentions, const std::string& meant) {
    auto& d =
        diagnostics_.error(base::Code::unknownResource, resource.place,
                           fmt::format("nothing names the resource '{}', and the resource '{}' is not there",
                                       resource.name, meant));
    d.resource = resource.name;
    if (mentions.first.file)
      d.found = fmt::format(
          "'{}' at {}:{}:{}{}", meant, *mentions.first.file, mentions.first.line, mentions.first.column,
          mentions.count == 2 ? " and once more" : fmt::format(" and {} times more", mentions.count - 1));
    d.hint = fmt::format("did you mean '{}'?", meant);
  }

  void mention(const std::string& name, const Place& place, std::uint32_t times = 1) {
    Mentions& mentions = mentions_[name.substr(0, name.find('.'))];
    mentions.count += times;
    if (!mentions.first.file) mentions.first = place;
  }

  void add(const RefDesc& ref) {
    mention(ref.name, ref.place, ref.import ? 0 : 1);
    add(ref.condition);
    if (ref.element) add(*ref.element);
  }
  void add(const Expr& expr) {
    if (!expr.present() || expr.isConstant()) return;
    for (const auto& [fact, name] : expr.facts())
      if (!name.starts_with('@') && (fact != Fact::has || !isPass(name))) mention(name, expr.place());
  }

  void addAll() {
    mentions_.clear();
    visitMentions(
        desc_, [&](const Expr& expr) { add(expr); },
        [&](const RefDesc& ref) { mention(ref.name, ref.place, ref.import ? 0 : 1); });
    for (const PassDesc& pass : desc_.passes) addInclude(pass);
  }

  void addInclude(const PassDesc& pass) {
    if (!pass.include) return;
    for (const auto& [input, ref] : pass.include->binds) add(ref);
    if (!pass.include->graph) return;
    // An input that is not bound takes the resource of its name.
    for (const ResourceDesc& input : pass.include->graph->resources)
      if (input.kind == ResourceDesc::Kind::input &&
          std::ranges::none_of(pass.include->binds,
                               [&](const auto& bind) { return bind.first == input.name; }))
        mention(input.name, pass.place, input.optional ? 0 : 1);
  }

  std::vector<ResourceDesc*> unmentioned() {
    std::vector<ResourceDesc*> found;
    for (ResourceDesc& resource : desc_.resources)
      if (resource.name.size() >= kShortest && !mentions_.contains(resource.name)) found.push_back(&resource);
    return found;
  }

  // What is named, is not there, and is one slip away. An input has its name from another file, so one mention is not enough.
  std::string meantBy(const ResourceDesc& resource) const {
    std::string meant;
    for (const std::string_view name : unknown_)
      if (mentions_.at(std::string(name)).count > (resource.kind == ResourceDesc::Kind::input ? 1U : 0U) &&
          (meant.empty() || name < meant) && base::editDistance(name, resource.name, 1) <= 1)
        meant = name;
    return meant;
  }
  bool isPass(const std::string& name) const {
    return std::ranges::find(desc_.passes, name, &PassDesc::name) != desc_.passes.end();
  }
  void findUnknown() {
    std::unordered_set<std::string_view> there(desc_.unread.begin(), desc_.unread.end());
    for (const ResourceDesc& resource : desc_.resources) there.insert(resource.name);
    for (const PassDesc& pass : desc_.passes)
      if (pass.include) there.insert(pass.name);
    for (const auto& [name, mentions] : mentions_)
      if (mentions.count > 0 && name.size() >= kShortest && !there.contains(name)) unknown_.push_back(name);
  }

  GraphDesc& desc_;
  base::Diagnostics& diagnostics_;
  std::unordered_map<std::string, Mentions> mentions_;  // by the first part of a name
  std::vector<std::string_view> unknown_;               // of these, what the file does not have
};

}  // namespace

void mendNames(GraphDesc& desc, base::Diagnostics& diagnostics) {
  NameMender(desc, diagnostics).run();
}

}  // namespace weft::graph
