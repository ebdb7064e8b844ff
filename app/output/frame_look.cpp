#include "app/output/frame_look.h"

#include "app/output/pictures.h"
#include "engine/glsl/source.h"
#include "engine/graph/print/print.h"
#include "engine/text/apart.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"
#include "engine/text/json/report.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

// ---- pictures ----

constexpr int kThumbnail = 160, kGrid = 28;  // texels of the longer side
constexpr std::size_t kPicturesOfStep = 24;  // levels and layers that are shown of what one step writes

Json pictureOf(const assets::Image8& image) {
  const double scale = std::min(1.0, static_cast<double>(kThumbnail) / std::max(image.width, image.height));
  const int width = std::max(1, static_cast<int>(image.width * scale)),
            height = std::max(1, static_cast<int>(image.height * scale));
  return {{"png", pictureAddress(scale < 1 ? assets::resize(image, width, height, true) : image)}};
}

// The values of every n-th texel, bottom row first, as numbers of four bytes.
Json gridOf(const assets::ImageF& values) {
  const int every = (std::max(values.width, values.height) + kGrid - 1) / kGrid;
  const auto channels = static_cast<std::size_t>(values.channels);
  std::vector<float> chosen;
  for (int y = 0; y < values.height; y += every)
    for (int x = 0; x < values.width; x += every) {
      const auto row = static_cast<std::size_t>(values.height - 1 - y);
      const float* const texel = &values.texels[(row * values.width + x) * channels];
      chosen.insert(chosen.end(), texel, texel + channels);
    }
  return {{"width", (values.width + every - 1) / every},
          {"height", (values.height + every - 1) / every},
          {"channels", channels},
          {"every", every},
          {"values",
           encodeBase64({reinterpret_cast<const char*>(chosen.data()), chosen.size() * sizeof(float)})}};
}

Json outputOf(const runtime::CaptureItem& item, runtime::Inspector& inspector,
              text::Diagnostics& diagnostics) {
  const runtime::InspectTarget& target = item.target;
  const gl::TextureDesc& size = inspector.picture().desc;
  std::string name = target.resource;
  if (target.mip > 0) name += fmt::format(".mip[{}]", target.mip);
  if (target.layer > 0) name += fmt::format(".layer[{}]", target.layer);
  if (target.stencil) name += ".stencil";
  Json out{{"name", name}, {"size", {size.width, size.height}}};
  const runtime::InspectView view = inspector.fittedView();
  if (const auto image = inspector.drawWhole(view, diagnostics)) out.update(pictureOf(*image));
  if (view.low != 0 || view.high != 1) out["shown"] = {view.low, view.high};
  const auto values = inspector.values();
  if (const auto found = inspector.measure(); found && values) {
    const auto listOf = [&](const std::array<double, 4>& all) {
      return std::vector<double>(all.begin(), all.begin() + values->channels);
    };
    out.update({{"low", listOf(found->low)},
                {"high", listOf(found->high)},
                {"mean", listOf(found->mean)},
                {"nan", found->nan},
                {"infinite", found->infinite}});
  }
  if (values) out["grid"] = gridOf(*values);
  return out;
}

// ---- a state ----

std::string placeText(const text::Place& place) {
  return place.file ? fmt::format("{}:{}", *place.file, place.line) : "";
}

// The file and line of main().
std::string mainOf(const std::string& shader, glsl::SourceLoader& sources) {
  text::Diagnostics ignored;
  const auto source = sources.load(shader, ignored);
  if (!source) return shader;
  return withoutFolder(placeText(source->placeOfMain()));
}

Json passesOf(const graph::Plan& plan, glsl::SourceLoader& sources) {
  Json all = Json::array();
  for (const graph::Step& step : plan.steps) {
    const graph::PassSpec& spec = plan.graph->specs[step.pass];
    Json pass{{"type", spec.type},
              {"place", withoutFolder(placeText(spec.place))},
              {"shader", Json::array()},
              {"parameters", Json::array()}};
    for (const std::string& shader : {spec.vertexShader, spec.shader})
      if (!shader.empty()) pass["shader"].push_back(mainOf(shader, sources));
    for (const graph::UniformSpec& uniform : spec.uniforms)
      if (uniform.isFirst())
        pass["parameters"].push_back(
            {{"name", uniform.name}, {"value", graph::toText(uniform.value)}, {"path", uniform.path}});
    all.push_back(std::move(pass));
  }
  return all;
}

Json parametersOf(const graph::Plan& plan) {
  Json all = Json::array();
  for (const graph::ParameterSpec& parameter : plan.graph->parameters)
    all.push_back({{"name", parameter.path},
                   {"value", graph::toText(parameter.value)},
                   {"from", graph::wordFor(parameter.origin)}});
  return all;
}

// What Graphviz makes of `dot`, as SVG; "" without Graphviz.
std::string svgOf(const std::string& dot) {
  constexpr std::uint64_t kPatience = 60;  // seconds of processor time
  const std::string svg = text::runApart({"dot", "-Tsvg"}, dot, kPatience).said;
  return svg.ends_with("</svg>\n") ? svg.substr(svg.find("<svg")) : "";
}

// The whole plan, and where it has effects, those as one box each.
Json flowOf(const graph::Plan& plan) {
  Json all = Json::array({svgOf(graph::dumpDot(plan))});
  if (std::ranges::any_of(plan.graph->passNames,
                          [](const std::string& name) { return name.find('.') != std::string::npos; }))
    all.push_back(svgOf(graph::dumpDot(plan, true)));
  return all;
}

}  // namespace

std::string withoutFolder(const std::string& path) {
  const std::string data = text::dataFolder() + "/";
  return path.starts_with(data) ? path.substr(data.size()) : path;
}

void FrameLook::begin(text::Diagnostics& diagnostics) {
  const std::string all = "*";
  std::vector<runtime::CaptureItem> items = runtime::captureItems(plan_, {&all, 1});
  std::vector<std::size_t> count(plan_.steps.size());
  std::erase_if(items,
                [&](const runtime::CaptureItem& item) { return ++count[item.step] > kPicturesOfStep; });
  outputs_ = Json(plan_.steps.size(), Json::array());
  runtime::watchItems(*renderer_.execution(), inspector_, items, [this, items, &diagnostics](std::size_t i) {
    if (inspector_.picture().id != 0)
      outputs_[items[i].step].push_back(outputOf(items[i], inspector_, diagnostics));
  });
}

Json FrameLook::end(const std::string& title, const std::vector<std::string>& facts,
                    const text::Diagnostics& said) {
  inspector_.release(*renderer_.execution());
  if (auto picture = renderer_.readPresented8()) picture_ = *std::move(picture);
  return {{"title", title},
          {"facts", facts},
          {"plan", text::loadJson(graph::dumpJson(plan_, true))},
          {"passes", passesOf(plan_, renderer_.device().sources)},
          {"parameters", parametersOf(plan_)},
          {"messages", text::loadJson(text::diagnosticsJson(text::chooseMessages(said), -1))},
          {"outputs", std::move(outputs_)},
          {"picture", pictureOf(picture_)},
          {"flow", flowOf(plan_)}};
}

}  // namespace weft::app
