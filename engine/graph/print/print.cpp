// One walk over a plan makes its data, which is also its JSON form; the text, the DOT graph and the lines of a difference are
// printed from that. Also the table of formats. Declared in print.h.
#include "engine/graph/print/print.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "engine/graph/subresource.h"
#include "engine/text/json/edit.h"
#include "engine/text/printable.h"

namespace weft::graph {

namespace {

using Json = nlohmann::ordered_json;

// ---- the data of a plan ----

Json barriersData(std::uint16_t mask) {
  Json names = Json::array();
  for (int i = 0; i < kBarrierBitCount; ++i)
    if ((mask >> i & 1) != 0) names.push_back(barrierName(static_cast<BarrierBit>(1 << i)));
  return names;
}

// Slot name per use; "" where the graph has none.
std::vector<std::string> slotNames(const FlatGraph& graph) {
  std::vector<std::string> names(graph.uses.size());
  for (const SlotSpec& slot : graph.slots) {
    for (std::uint32_t i = 0; i < slot.useCount && slot.firstUse + i < names.size(); ++i)
      names[slot.firstUse + i] = slot.array ? fmt::format("{}[{}]", slot.name, i) : slot.name;
    if (slot.firstValue != kNone) names[slot.firstValue] = slot.name + " (first)";
  }
  return names;
}

Json usesData(const Plan& plan, std::uint32_t pass, const std::vector<std::string>& slots) {
  const FlatGraph& graph = *plan.graph;
  Json uses = Json::array();
  for (const std::uint32_t u : graph.usesOf(pass)) {
    const FlatUse& use = graph.uses[u];
    Json json = Json::object();  // made here: where there is no memory for one, `[]` would leave half of it
    if (!slots[u].empty()) json["slot"] = slots[u];
    json.update({{"access", nameOf(use.access)},
                 {"kind", nameOf(use.kind)},
                 {"resource", graph.resourceNames[use.resource]},
                 {"range", textOf(graph, use)},
                 {"attached", plan.attached[u] != 0}});
    if (use.history > 0) json["history"] = use.history;
    if (use.feedback) json["feedback"] = true;
    uses.push_back(std::move(json));
  }
  return uses;
}

// The attachments that a pass's live uses make; null when there are none.
Json framebufferData(const Plan& plan, std::uint32_t pass) {
  const FlatGraph& graph = *plan.graph;
  Json json;
  for (const std::uint32_t u : graph.usesOf(pass)) {
    const FlatUse& use = graph.uses[u];
    if (plan.attached[u] == 0 || (use.kind != Kind::color && use.kind != Kind::depth)) continue;
    const FlatResource& r = graph.resources[use.resource];
    const auto [width, height, depth] = sizeAt(r, use.mip);
    if (json.is_null()) json = {{"size", {width, height}}, {"color", Json::array()}, {"depth", ""}};
    if (use.kind == Kind::color)
      json["color"].push_back(textOf(graph, use));
    else
      json["depth"] = textOf(graph, use);
  }
  return json;
}

Json resourceData(const Plan& plan, std::uint32_t r) {
  const FlatResource& resource = plan.graph->resources[r];
  Json json{{"name", plan.graph->resourceNames[r]},
            {"shape", shapeText(resource)},
            {"bytes", resource.bytes},
            {"imported", isImported(resource)}};
  if (!isBuffer(resource)) {
    json["format"] = infoOf(resource.format).name;
    json["size"] = {resource.width, resource.height};
  }
  if (resource.history > 0) json["history"] = resource.history;
  if (plan.copiesOf(r) > 1) json["copies"] = plan.copiesOf(r);
  if (plan.persistent[r] != 0) json["persistent"] = true;
  if (plan.firstStep[r] != kNone) json["steps"] = {plan.firstStep[r], plan.lastStep[r]};
  if (plan.storageOf[r] != kNone) json["storage"] = plan.storageOf[r];
  if (plan.bufferOffsetOf[r] != Plan::kNoOffset) json["offset"] = plan.bufferOffsetOf[r];
  return json;
}

Json dataOf(const Plan& plan, bool explain) {
  const FlatGraph& graph = *plan.graph;
  const std::vector<std::string> slots = slotNames(graph);
  std::optional<Explainer> explainer;
  if (explain) explainer.emplace(plan);
  const auto end = static_cast<std::uint32_t>(plan.steps.size());

  Json json{{"name", graph.name},
            {"bytes",
             {{"declared", plan.bytesDeclared},
              {"allocated", plan.bytesAllocated},
              {"lower_bound", plan.bytesLowerBound},
              {"arena", plan.arenaBytes},
              {"bound", plan.bytesBound}}},
            {"steps", Json::array()}};
  for (std::uint32_t t = 0; t < end; ++t) {
    const Step& step = plan.steps[t];
    const FlatPass& pass = graph.passes[step.pass];
    Json s{{"pass", graph.passNames[step.pass]}, {"update", updateOf(pass)}};
    if (pass.slices != 1) s["slices"] = pass.slices;
    if (pass.sideEffect) s["side_effect"] = true;
    s["barriers"] = barriersData(step.barriers);
    s["clears"] = Json::array();
    for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c)
      s["clears"].push_back(textOf(graph, plan.clears[c].use));
    if (step.barriersAfterClears != 0) s["barriers_after_clears"] = barriersData(step.barriersAfterClears);
    s["uses"] = usesData(plan, step.pass, slots);
    if (Json framebuffer = framebufferData(plan, step.pass); !framebuffer.is_null())
      s["framebuffer"] = std::move(framebuffer);
    if (explain) {
      s["why"] = explainer->whyPass(step.pass);
      s["why_here"] = explainer->whyHere(step.pass);
      s["why_barriers"] = explainer->whyBarriers(t, false);
      s["why_barriers_after_clears"] = explainer->whyBarriers(t, true);
    }
    json["steps"].push_back(std::move(s));
  }
  json["final_barriers"] = barriersData(plan.finalBarriers);
  if (explain) json["why_final_barriers"] = explainer->whyBarriers(end, false);
  if (graph.present.resource != kNone) json["present"] = textOf(graph, graph.present);
  for (const char* list : {"outputs", "culled", "disabled", "storages", "resources"})
    json[list] = Json::array();
  for (std::size_t i = 0; i < graph.outputs.size(); ++i)
    json["outputs"].push_back({{"name", graph.outputNames[i]},
                               {"resource", textOf(graph, graph.outputs[i])},
                               {"live", plan.outputLive[i] != 0}});
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    if (plan.stepOf[p] != kNone) continue;
    Json c{{"pass", graph.passNames[p]}, {"uses", usesData(plan, p, slots)}};
    if (explain) c["why"] = explainer->whyPass(p);
    json["culled"].push_back(std::move(c));
  }
  for (const DisabledPass& d : graph.disabled) json["disabled"].push_back({{"pass", d.name}, {"why", d.why}});
  for (const Storage& s : plan.storages)
    json["storages"].push_back({{"target", nameOf(s.target)},
                                {"format", infoOf(s.format).name},
                                {"width", s.width},
                                {"height", s.height},
                                {"depth", s.depth},
                                {"layers", s.layers},
                                {"mips", s.mips},
                                {"samples", s.samples},
                                {"copies", s.copies},
                                {"shared", s.shared},
                                {"persistent", s.persistent},
                                {"bytes", s.bytes}});
  for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
    json["resources"].push_back(resourceData(plan, r));
    if (explain) json["resources"].back()["why"] = explainer->whyStorage(r);
  }
  return json;
}

// A word, or a number as it is written.
std::string wordOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : text::dumpJson(value, -1);
}

std::string joined(const Json& words, const char* between = " ") {
  return fmt::format("{}", fmt::join(words.get<std::vector<std::string>>(), between));
}

// ---- text ----

// " mips 3", " update once", " persistent"; "" of what is not there, or as it mostly is.
std::string optionOf(const Json& data, const char* key) {
  const auto found = data.find(key);
  if (found == data.end() || *found == false || *found == 1 || *found == "always") return "";
  return found->is_boolean() ? fmt::format(" {}", key) : fmt::format(" {} {}", key, wordOf(*found));
}

void addWhy(std::string& text, std::size_t depth, const Json& data, const std::string& key = "why") {
  const auto why = data.find(key);
  if (why == data.end()) return;
  if (*why != "") addLine(text, depth, "why {}", wordOf(*why));
}

void addBarriers(std::string& text, const Json& data, const char* word, const std::string& key) {
  const auto bits = data.find(key);
  if (bits == data.end() || bits->empty()) return;
  const auto why = data.find("why_" + key);  // a text for each bit
  if (why == data.end()) return addLine(text, 2, "{} {}", word, joined(*bits));
  for (const Json& each : *why) addLine(text, 2, "{} {}", word, wordOf(each));
}

void addStep(std::string& text, std::size_t index, const Json& step) {
  addLine(text, 1, "{} {}{}{}{}", index, wordOf(step["pass"]), optionOf(step, "update"),
          optionOf(step, "slices"), optionOf(step, "side_effect"));
  addWhy(text, 2, step);
  addWhy(text, 2, step, "why_here");
  addBarriers(text, step, "barrier", "barriers");
  for (const Json& clear : step["clears"]) addLine(text, 2, "clear {}", wordOf(clear));
  addBarriers(text, step, "barrier_after_clears", "barriers_after_clears");
  for (const Json& use : step["uses"])
    addLine(text, 2, "{} {}{} {}{}{}", wordOf(use["access"]),
            use.contains("slot") ? wordOf(use["slot"]) + " " : "", wordOf(use["kind"]), wordOf(use["range"]),
            optionOf(use, "feedback"), use["attached"] ? "" : " (not attached: nobody reads it)");
  if (const auto made = step.find("framebuffer"); made != step.end()) {
    std::string attachments;
    for (const Json& color : (*made)["color"]) attachments += " color " + wordOf(color);
    if ((*made)["depth"] != "") attachments += " depth " + wordOf((*made)["depth"]);
    addLine(text, 2, "framebuffer {}x{}{}", wordOf((*made)["size"][0]), wordOf((*made)["size"][1]),
            attachments);
  }
}

// "2..5", "2..end": the steps in which a resource is alive.
std::string lifetimeOf(const Json& data, const Json& resource) {
  const Json& last = resource["steps"][1];
  return fmt::format("{}..{}", wordOf(resource["steps"][0]),
                     last == data["steps"].size() ? "end" : wordOf(last));
}

void addTexture(std::string& text, const Json& data, std::size_t index) {
  const Json& s = data["storages"][index];
  std::string head =
      fmt::format("{} {} {}x{}", index, wordOf(s["target"]), wordOf(s["width"]), wordOf(s["height"]));
  if (s["target"] == "3d") head += "x" + wordOf(s["depth"]);
  head += " " + wordOf(s["format"]);
  for (const char* key : {"mips", "layers", "samples", "copies", "persistent"}) head += optionOf(s, key);
  addLine(text, 1, "{} bytes {}", head, wordOf(s["bytes"]));
  std::vector<const Json*> users;
  for (const Json& resource : data["resources"])
    if (resource.value("storage", ~std::size_t{0}) == index) users.push_back(&resource);
  std::ranges::stable_sort(users, {}, [](const Json* user) { return (*user)["steps"][0].get<unsigned>(); });
  for (const Json* user : users) {
    const Json& format = (*user)["format"];
    addLine(text, 2, "{} {}{}", lifetimeOf(data, *user), wordOf((*user)["name"]),
            format == s["format"] ? "" : " as " + wordOf(format));
    addWhy(text, 3, *user);
  }
}

void addBuffer(std::string& text, const Json& data, const Json& buffer) {
  addLine(text, 1, "{} {}{} bytes {}", wordOf(buffer["name"]), lifetimeOf(data, buffer),
          optionOf(buffer, "persistent") + optionOf(buffer, "offset") + optionOf(buffer, "copies"),
          wordOf(buffer["bytes"]));
  addWhy(text, 2, buffer);
}

}  // namespace

std::string dumpJson(const Plan& plan, bool explain) {
  return text::dumpJson(dataOf(plan, explain)) + "\n";
}

std::string dumpText(const Plan& plan, bool explain) {
  const Json data = dataOf(plan, explain);
  const Json &steps = data["steps"], &culled = data["culled"], &bytes = data["bytes"];
  std::string text;
  addLine(text, 0, "plan {}", data["name"] == "" ? "-" : wordOf(data["name"]));
  addLine(text, 0, "passes {} run {}", steps.size() + culled.size(), steps.size());
  text += "bytes";
  for (const auto& [key, value] : bytes.items()) text += fmt::format(" {} {}", key, wordOf(value));
  text += "\n\norder\n";
  for (std::size_t t = 0; t < steps.size(); ++t) addStep(text, t, steps[t]);
  text += "  end\n";
  addBarriers(text, data, "barrier", "final_barriers");
  if (data.contains("present")) addLine(text, 2, "present {}", wordOf(data["present"]));
  for (const Json& output : data["outputs"])
    addLine(text, 2, "output {} {}{}", wordOf(output["name"]), wordOf(output["resource"]),
            output["live"] ? "" : " (nothing makes it)");
  text += "\ntextures\n";
  for (std::size_t i = 0; i < data["storages"].size(); ++i) addTexture(text, data, i);
  // A list has a heading when it has a line.
  const auto addList = [&](const char* heading, const Json& list, const auto& add) {
    std::string lines;
    for (const Json& each : list) add(lines, each);
    if (!lines.empty()) text += fmt::format("\n{}\n{}", heading, lines);
  };
  addList("buffers", data["resources"], [&](std::string& lines, const Json& resource) {
    if (resource.contains("steps") && !resource.contains("format") && !resource["imported"])
      addBuffer(lines, data, resource);
  });
  addList("culled", culled, [](std::string& lines, const Json& pass) {
    addLine(lines, 1, "{}", wordOf(pass["pass"]));
    addWhy(lines, 2, pass);
  });
  std::string reason;  // of the passes before, too
  addList("disabled", data["disabled"], [&](std::string& lines, const Json& pass) {
    if (explain && pass["why"] != reason) addLine(lines, 1, "{}", reason = wordOf(pass["why"]));
    addLine(lines, explain ? 2 : 1, "{}", wordOf(pass["pass"]));
  });
  return text;
}

// ---- differences ----

namespace {

// Something that a plan has or lacks, under a name.
struct PlanFact {
  std::string name, text = "none";
  bool there = true;
};

// The passes that both plans run, without those that moved: a longest row of them that both have in one order.
std::set<std::string> findKept(const Json& before, const Json& after) {
  std::map<std::string, std::size_t> stepBefore;
  for (std::size_t i = 0; i < before["steps"].size(); ++i) stepBefore[wordOf(before["steps"][i]["pass"])] = i;
  struct Row {
    std::size_t last;
    std::vector<std::string> names;
  };
  std::vector<Row> rows;  // by length: the one that ends earliest
  for (const Json& step : after["steps"]) {
    const std::string name = wordOf(step["pass"]);
    const auto found = stepBefore.find(name);
    if (found == stepBefore.end()) continue;
    const auto at = std::ranges::lower_bound(rows, found->second, {}, &Row::last);
    Row row = at == rows.begin() ? Row{} : *std::prev(at);
    row.last = found->second;
    row.names.push_back(name);
    if (at == rows.end())
      rows.push_back(std::move(row));
    else
      *at = std::move(row);
  }
  return rows.empty() ? std::set<std::string>()
                      : std::set<std::string>(rows.back().names.begin(), rows.back().names.end());
}

std::vector<PlanFact> planFactsOf(const Json& data, const std::set<std::string>& kept) {
  std::vector<PlanFact> facts;
  const auto addPass = [&](const Json& pass, std::string text, bool runs) {
    const std::string name = wordOf(pass["pass"]);
    if (!kept.contains(name)) facts.push_back({"pass " + name, std::move(text), runs});
  };
  const auto addBits = [&](std::string where, const Json& bits) {
    facts.push_back({std::move(where), joined(bits), !bits.empty()});
  };
  for (std::size_t i = 0; i < data["steps"].size(); ++i)
    addPass(data["steps"][i], fmt::format("step {}", i), true);
  for (const Json& pass : data["culled"]) addPass(pass, "culled", false);
  for (const Json& pass : data["disabled"]) addPass(pass, "disabled, " + wordOf(pass["why"]), false);
  for (const Json& step : data["steps"]) {
    addBits("barrier before " + wordOf(step["pass"]), step["barriers"]);
    addBits("barrier behind the clears of " + wordOf(step["pass"]),
            step.value("barriers_after_clears", Json::array()));
  }
  addBits("barrier at the end of the frame", data["final_barriers"]);
  for (const Json& r : data["resources"])
    facts.push_back(
        {"resource " + wordOf(r["name"]),
         wordOf(r["shape"]) + (r.contains("copies") ? fmt::format(", {} copies", wordOf(r["copies"])) : ""),
         r.contains("steps")});
  facts.push_back({"textures", fmt::to_string(data["storages"].size())});
  for (const char* key : {"declared", "allocated", "arena", "bound"})
    facts.push_back({fmt::format("bytes {}", key), wordOf(data["bytes"][key])});
  return facts;
}

}  // namespace

std::string diffText(const Plan& before, const Plan& after) {
  const Json was = dataOf(before, false), now = dataOf(after, false);
  const std::set<std::string> kept = findKept(was, now);
  std::vector<std::pair<PlanFact, PlanFact>> pairs;  // one is not there where only the other plan has it
  std::map<std::string, std::size_t> known;
  for (PlanFact& fact : planFactsOf(was, kept)) {
    known.emplace(fact.name, pairs.size());
    pairs.push_back({std::move(fact), {.there = false}});
  }
  for (PlanFact& fact : planFactsOf(now, kept))
    if (const auto found = known.find(fact.name); found != known.end())
      pairs[found->second].second = std::move(fact);
    else
      pairs.push_back({PlanFact{.name = fact.name, .there = false}, fact});
  std::string text;
  for (const auto& [a, b] : pairs)
    if ((a.there || b.there) && (a.there != b.there || a.text != b.text))
      addLine(text, 0, "{} {}: {} before, now {}",
              !a.there   ? '+'
              : !b.there ? '-'
                         : '~',
              a.name, a.text, b.text);
  return text;
}

// ---- formats ----

FormatUses usesOf(Format format) {
  const FormatInfo& info = infoOf(format);
  const bool whole = info.kind == TexelKind::unsigned_integer || info.kind == TexelKind::signed_integer;
  return {.attachment = info.colorRenderable || isDepth(format),
          .blended = info.colorRenderable && !whole,
          .filtered = info.kind != TexelKind::none && !whole,
          .image = info.imageStorable};
}

std::string formatTable() {
  constexpr const char* kKinds[] = {"nothing", "normalized", "float",        "unsigned",
                                    "signed",  "depth",      "depth/stencil"};
  constexpr const char* kLine = "{:<18}{:>6}{:>9}  {:<18}{:<11}{:<8}{:<9}{}\n";
  const auto mark = [](bool can) { return can ? "yes" : "-"; };
  std::string text = fmt::format(fmt::runtime(kLine), "name", "bytes", "channels", "texels", "attachment",
                                 "blend", "filter", "as image");
  for (const std::string& name : formatNames()) {
    const FormatInfo& info = infoOf(*findFormat(name));
    const FormatUses uses = usesOf(*findFormat(name));
    text += fmt::format(fmt::runtime(kLine), name, info.bytes, info.channels,
                        kKinds[static_cast<std::size_t>(info.kind)], mark(uses.attachment),
                        mark(uses.blended), mark(uses.filtered), uses.image ? name : "-");
  }
  return text;
}

void addPlainLine(std::string& text, std::size_t depth, std::string_view line) {
  text += std::string(2 * depth, ' ') + text::printable(line) + '\n';
}

}  // namespace weft::graph
