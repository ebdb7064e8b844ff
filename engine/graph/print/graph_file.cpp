// A plan as a graph file. Declared in print.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "engine/graph/language/keys.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"
#include "engine/text/json/edit.h"

namespace weft::graph {

namespace {

using Json = nlohmann::ordered_json;

std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (c == '#')
      plain += "_v";
    else if (c == '.' || c == '[' || c == ',')
      plain += '_';
    else if (c != ']' && c != '@')
      plain += c;
  return plain;
}

// "maps[3]#2": the array "maps_v2" and its element 3.
struct ElementName {
  std::string array;
  std::string index;  // "" for no element
};

ElementName elementName(const std::string& name) {
  const std::size_t open = name.find('['), close = name.find(']');
  if (open == std::string::npos) return {plainName(name), ""};
  return {plainName(name.substr(0, open) + name.substr(close + 1)), name.substr(open + 1, close - open - 1)};
}

class FileWriter {
 public:
  explicit FileWriter(const Plan& plan)
      : plan_(plan), graph_(*plan.graph), used_(graph_.resources.size(), 0) {}

  std::string write() {
    Json file;
    file["name"] = graph_.name;
    Json passes = Json::array();
    for (std::uint32_t pass = 0; pass < graph_.passes.size(); ++pass)
      if (plan_.stepOf[pass] != kNone) passes.push_back(passJson(pass));
    if (graph_.present.resource != kNone) use(graph_.present.resource);
    for (const FlatUse& output : graph_.outputs) use(output.resource);
    for (const HistorySpec& history : graph_.histories)
      if (used_[history.resource] != 0)
        for (const std::uint32_t other : history.resetResources) use(other);
    file["resources"] = resourcesJson();
    file["passes"] = std::move(passes);
    if (graph_.present.resource != kNone) {
      FlatUse shown = graph_.present;  // the first level goes without saying
      if (const FlatResource& r = graph_.resources[shown.resource]; shown.mip == 0 && shown.mips == 1)
        shown.mips = r.mips;
      file["present"] = textOf(shown, false, graph_.present.mips > 1);
    }
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      if (plan_.outputLive[i] != 0)
        file["outputs"][plainName(graph_.outputNames[i])] = textOf(graph_.outputs[i], false);
    return text::dumpJson(file, 2, false) + "\n";
  }

 private:
  // ---- names ----

  // Of an import that is to be declared, with those that its arguments name.
  std::string importName(std::uint32_t import) {
    std::string name = nameOfImport(import);
    if (named_.insert(name).second)
      for (const auto& [key, value] : graph_.imports[import].request.arguments)
        if (const ImportRequest* other = graph_.imports[import].request.named(key))
          importName(indexOf(*other));
    return name;
  }

  std::uint32_t indexOf(const ImportRequest& request) const {
    return static_cast<std::uint32_t>(std::ranges::find(graph_.imports, request, &ImportSpec::request) -
                                      graph_.imports.begin());
  }

  std::string nameOfImport(std::uint32_t import) const {
    const ImportSpec& spec = graph_.imports[import];
    // A view under the name of its type would be the view of all passes.
    if (spec.kind == ImportKind::view)
      return plainName(spec.name) + (spec.name == spec.request.type ? "_view" : "");
    const auto resource = std::ranges::find(graph_.resources, import, &FlatResource::import);
    const bool named = resource != graph_.resources.end();
    return elementName(
               named ? graph_.resourceNames[static_cast<std::size_t>(resource - graph_.resources.begin())]
                     : spec.name)
        .array;
  }

  // The resource is to be declared.
  void use(std::uint32_t resource) {
    used_[resource] = 1;
    if (const std::uint32_t import = graph_.resources[resource].import; import != kNone) importName(import);
  }

  // `span`: also levels that are all there are.
  std::string textOf(const FlatUse& use, bool wholeArray, bool span = false) const {
    const FlatResource& r = graph_.resources[use.resource];
    const ElementName name = elementName(graph_.resourceNames[use.resource]);
    std::string text = name.array;
    if (!wholeArray && !name.index.empty()) text += "[" + name.index + "]";
    if (!isBuffer(r)) {
      const bool cube = isCube(r);
      if (use.mips < r.mips || span) text += spanText("mip", use.mip, use.mips);
      if (use.layers < r.layers && !cube) text += spanText("layer", use.layer, use.layers);
      if (use.layers < r.layers && cube) {
        if (r.layers > 6) text += spanText("layer", use.layer / 6, std::max(1, use.layers / 6));
        if (use.layers < 6) text += spanText("face", use.layer % 6, use.layers);
      }
      if (planesOf(r) == 2 && use.planes == 2) text += ".stencil";
    }
    if (use.history > 0) text += fmt::format("@-{}", use.history);
    return text;
  }

  // A folded expression, with names and values for its keys: "age(#3)" and "$#2".
  std::string expressionText(const Expr& expr) {
    return expr.text([&](std::uint32_t key, bool ofAge) {
      if (ofAge) {
        use(key);
        const std::uint32_t import = graph_.resources[key].import;
        return fmt::format(
            "age({})", import == kNone ? elementName(graph_.resourceNames[key]).array : importName(import));
      }
      if (key < graph_.parameters.size()) return graph::toText(graph_.parameters[key].value);
      const WatchedValue& watched = graph_.watched[key - graph_.parameters.size()];
      return "@" + importName(watched.import) + watched.text();
    });
  }

  // ---- resources ----

  Json resourcesJson() {
    Json all = Json::object(), textures = Json::object();
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r) {
      if (used_[r] == 0 || isImported(graph_.resources[r])) continue;
      const ElementName name = elementName(graph_.resourceNames[r]);
      if (!textures.contains(name.array)) textures[name.array] = resourceJson(r);
      if (name.index.empty()) continue;
      Json& array = textures[name.array]["array"];
      const int count = std::stoi(name.index) + 1;
      array = array.is_number() ? std::max(array.get<int>(), count) : count;
    }
    for (std::uint32_t import = 0; import < graph_.imports.size(); ++import) {
      const ImportSpec& spec = graph_.imports[import];
      if (elementOf(spec.request) > 0 || !named_.contains(nameOfImport(import))) continue;
      Json json{{"import", spec.request.type}};
      for (const auto& [name, value] : spec.request.arguments) {
        // An empty word is what an argument is when nothing is given; written, it would be an empty expression.
        const bool given =
            value.type == Value::Type::symbol ? !value.symbol.empty() : value.type != Value::Type::none;
        const ImportRequest* named = spec.request.named(name);
        if (name == "element" || (!given && !named)) continue;
        const bool path = name.ends_with("file") && !value.symbol.empty();
        json[name] = named  ? Json(importName(indexOf(*named)))
                     : path ? Json(std::filesystem::absolute(value.symbol).lexically_normal().string())
                            : jsonOf(value);
      }
      all[importName(import)] = std::move(json);
    }
    all.update(textures);
    return all;
  }

  Json resourceJson(std::uint32_t index) {
    const FlatResource& r = graph_.resources[index];
    Json json;
    if (isBuffer(r)) {
      json["buffer"] = r.bytes;
    } else {
      const bool cube = isCube(r);
      json["texture"] = infoOf(r.format).name;
      json["size"] =
          r.target == Target::texture_3d ? Json{r.width, r.height, r.depth} : Json{r.width, r.height};
      if (r.mips > 1) json["mips"] = r.mips;
      if (r.samples > 1) json["samples"] = r.samples;
      if (r.target != Target::texture_2d && r.target != Target::texture_2d_multisample)
        json["view"] = nameOf(r.target);
      const std::uint32_t layers = cube ? r.layers / 6 : r.layers;
      if (r.target == Target::texture_2d_array || r.target == Target::texture_cube_array)
        json["layers"] = layers;
    }
    for (const ClearSpec& clear : graph_.clears)
      if (clear.resource == index) json["clear"] = jsonOf(clear.value);
    for (const HistorySpec& history : graph_.histories) {
      if (history.resource != index) continue;
      json["history"] = r.history;
      json["first"] =
          history.firstUse.resource == kNone ? jsonOf(history.first) : Json(textOf(history.firstUse, false));
      Json reset = Json::array();
      for (const std::uint32_t import : history.resetImports) reset.push_back("@" + importName(import));
      for (const std::uint32_t other : history.resetResources)
        reset.push_back(elementName(graph_.resourceNames[other]).array);
      for (const Value& value : history.resetValues)  // a word resets nothing
        if (value.isNumeric() || value.type == Value::Type::list) reset.push_back(graph::toText(value));
      if (!reset.empty()) json["reset"] = std::move(reset);
    }
    return json;
  }

  // ---- passes ----

  Json passJson(std::uint32_t pass) {
    const PassSpec& spec = graph_.specs[pass];
    const FlatPass& flat = graph_.passes[pass];
    Json json{{"name", plainName(spec.name)}, {"type", spec.type}};
    if (!spec.vertexShader.empty())
      json["shader"] = {{"vertex", spec.vertexShader}, {"fragment", spec.shader}};
    else if (!spec.shader.empty())
      json["shader"] = spec.shader;
    addUniforms(spec, json);
    addSlots(spec, json);
    addDrawing(spec, json);
    addState(spec, json);
    if (flat.cadence != Cadence::always) json["update"] = updateOf(flat);
    if (flat.slices != 1) json["slices"] = flat.slices;
    if (flat.sideEffect) json["side_effect"] = true;
    for (const std::uint32_t u : graph_.usesOf(pass)) {
      use(graph_.uses[u].resource);
      if (graph_.uses[u].feedback) json["feedback"] = true;
    }
    return json;
  }

  void addUniforms(const PassSpec& spec, Json& json) {
    Json parameters, defines;
    for (const DefineSpec& define : spec.defines) defines[define.name] = text::loadJson(define.text);
    for (const UniformSpec& uniform : spec.uniforms) {
      const WatchedValue* const followed = graph_.followedBy(uniform);
      const bool timed = followed || uniform.dynamic.dynamic();
      if (followed && followed->part != kWholeValue) {
        parameters[uniform.name] = expressionText(uniform.dynamic);  // all columns of a matrix
        continue;
      }
      Json& value = parameters[uniform.name];
      (uniform.element == kNone ? value : value.emplace_back()) =
          timed ? Json(expressionText(uniform.dynamic)) : jsonOf(uniform.value);
    }
    if (!parameters.is_null()) json["parameters"] = std::move(parameters);
    if (!defines.is_null()) json["defines"] = std::move(defines);
  }

  void addSlots(const PassSpec& spec, Json& json) const {
    for (const SlotSpec& slot : graph_.slotsOf(spec)) {
      if (slot.useCount == 0) continue;
      std::string text = textOf(graph_.uses[slot.firstUse], slot.array) + " as " + nameOf(slot.kind);
      if (slot.sampler.function)
        text += fmt::format(" compare({})", kCompareNames[static_cast<std::size_t>(*slot.sampler.function)]);
      else if (slot.sampler.linear)
        text += " linear";
      const BorderColor color = graph_.borderOf(slot);
      if (slot.sampler.wrap == Wrap::repeat) text += " wrap";
      if (slot.sampler.wrap == Wrap::mirror) text += " mirror";
      if (slot.sampler.wrap == Wrap::border)
        text += fmt::format(" border({}, {}, {}, {})", color[0], color[1], color[2], color[3]);
      json[nameOf(slot.access)][slot.name] = text;
    }
  }

  void addDrawing(const PassSpec& spec, Json& json) {
    if (spec.threadsPlace.line > 0) json["threads"] = {spec.threads[0], spec.threads[1], spec.threads[2]};
    if (!spec.list.empty()) json["list"] = spec.listImport == kNone ? spec.list : importName(spec.listImport);
    if (!spec.geometry.empty()) {
      json["geometry"] = spec.geometry;
      if (!spec.geometryArguments.empty())
        json["geometry"] = fmt::format("{}({})", spec.geometry, fmt::join(spec.geometryArguments, ", "));
      if (spec.list.empty() && !spec.indirect)
        json["instances"] =
            spec.timedInstances.present() ? Json(expressionText(spec.timedInstances)) : Json(spec.instances);
    }
    if (spec.raster[0] > 0) json["raster"] = spec.raster;
    if (!spec.shader.empty() && spec.screen != std::array{graph_.screenWidth, graph_.screenHeight})
      json["screen"] = spec.screen;
    if (spec.rasterSamples > 1) json["samples"] = spec.rasterSamples;
    if (spec.draws != 1) json["draws"] = spec.draws;
    if (spec.view == kNone) return;
    std::string view = importName(spec.view);
    if (spec.viewLayer > 0 || spec.viewFace > 0)
      view += fmt::format("[{}].face[{}]", spec.viewLayer, spec.viewFace);
    json["view"] = view;
  }

  template <class Enum>
  static std::string_view wordOf(std::string_view key, Enum value) {
    return stateWords(key)[static_cast<std::size_t>(value)];
  }

  static void addStencil(const StencilState& stencil, Json& json) {
    const auto addFace = [](const StencilFace& face, Json& out) {
      out["test"] = wordOf("stencil.test", face.test);
      out["fail"] = wordOf("stencil.pass", face.fail);
      out["depth_fail"] = wordOf("stencil.pass", face.depthFail);
      out["pass"] = wordOf("stencil.pass", face.pass);
    };
    addFace(stencil.front, json);
    json["reference"] = stencil.reference;
    json["read_mask"] = stencil.readMask;
    json["write_mask"] = stencil.writeMask;
    if (stencil.back != stencil.front) addFace(stencil.back, json["back"]);
  }

  static void addState(const PassSpec& spec, Json& json) {
    const StateSpec& state = spec.state;
    Json out;
    for (const auto& [slot, color] : state.colors) {
      const auto known = std::ranges::find(kBlends, color.blend);
      Json& blend = out["blend"][slot];
      if (known != kBlends.end())
        blend = stateWords("blend")[static_cast<std::size_t>(known - kBlends.begin())];
      else
        for (const bool alpha : {false, true}) {
          const BlendPart& part = alpha ? color.blend.alpha : color.blend.color;
          const std::string end = alpha ? "_alpha" : "";
          blend["source" + end] = wordOf("blend.x.source", part.source);
          blend["destination" + end] = wordOf("blend.x.source", part.destination);
          blend["equation" + end] = wordOf("blend.x.equation", part.equation);
        }
      std::string mask;
      for (unsigned channel = 0; channel < 4; ++channel)
        if ((color.mask >> channel & 1) != 0) mask += "rgba"[channel];
      if (color.mask != 15) out["color_mask"][slot] = mask.empty() ? "none" : mask;
    }
    if (state.blendColor != std::array<double, 4>{}) out["blend_color"] = state.blendColor;
    if (state.stencil) addStencil(*state.stencil, out["stencil"]);
    if (state.viewport) out["viewport"] = *state.viewport;
    if (state.sampleMask) out["sample_mask"] = *state.sampleMask;
    if (state.alphaToCoverage) out["alpha_to_coverage"] = true;
    if (state.depthClamp) out["depth_clamp"] = true;
    if (state.depthTest) out["depth_test"] = kCompareNames[static_cast<std::size_t>(state.depthCompare)];
    if (!state.depthWrite) out["depth_write"] = false;
    if (state.cull != Cull::none) out["cull"] = wordOf("cull", state.cull);
    if (state.lines) out["polygon"] = "line";
    if (state.offsetFactor != 0 || state.offsetUnits != 0)
      out["offset"] = {state.offsetFactor, state.offsetUnits};
    if (!out.is_null()) json["state"] = std::move(out);
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  std::vector<std::uint8_t> used_;  // per resource
  std::set<std::string> named_;     // imports
};

}  // namespace

std::string graphFileOf(const Plan& plan) {
  return FileWriter(plan).write();
}

}  // namespace weft::graph
