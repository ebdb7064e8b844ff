// weft report: one HTML page of a frame, or of what differs between two: app/report/page.html with the data that its script draws.

#include <cmath>
#include <cstdio>
#include <sstream>

#include "app/commands/commands.h"
#include "app/output/pictures.h"
#include "app/trials/shot.h"
#include "engine/assets/images/image.h"
#include "engine/glsl/source.h"
#include "engine/graph/print/print.h"
#include "engine/runtime/inspection/inspector.h"
#include "engine/text/json/report.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

// ---- pictures ----

constexpr int kThumbnail = 160, kGrid = 32;  // texels of the longer side
constexpr std::size_t kPicturesOfStep = 24;  // levels and layers that are shown of what one step writes

template <class T>
std::string base64Of(const std::vector<T>& numbers) {
  return encodeBase64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

Json pictureOf(const assets::Image8& image) {
  const double scale = std::min(1.0, static_cast<double>(kThumbnail) / std::max(image.width, image.height));
  const int width = std::max(1, static_cast<int>(image.width * scale)),
            height = std::max(1, static_cast<int>(image.height * scale));
  return {{"png", pictureAddress(scale < 1 ? assets::resize(image, width, height, true) : image)}};
}

// The exact values of every n-th texel, bottom row first: as numbers of two bytes where those hold all of them, else of four.
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
  std::vector<std::uint16_t> halves(chosen.size());
  assets::floatsToHalves(chosen, halves);
  const bool half = std::ranges::equal(chosen, halves, [](float value, std::uint16_t bits) {
    return std::isnan(value) || assets::halfToFloat(bits) == value;
  });
  return {{"width", (values.width + every - 1) / every},
          {"height", (values.height + every - 1) / every},
          {"channels", channels},
          {"every", every},
          {"half", half},
          {"values", half ? base64Of(halves) : base64Of(chosen)}};
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

// Without the data folder, so that a page does not depend on where Weft is.
std::string withoutFolder(const std::string& path) {
  const std::string data = dataFolder() + "/";
  return path.starts_with(data) ? path.substr(data.size()) : path;
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

Json messagesOf(const text::Diagnostics& diagnostics) {
  Json all = text::loadJson(text::diagnosticsJson(text::chooseMessages(diagnostics), -1));
  for (Json& each : all)
    if (each.contains("file"))
      each["place"] = fmt::format("{}:{}:{}", each["file"].get<std::string>(), each.value("line", 0),
                                  each.value("column", 0));
  return all;
}

// What Graphviz makes of `dot`, as SVG; "" without Graphviz. The file between has no name that anybody could take.
std::string svgOf(const std::string& dot) {
  std::FILE* const file = std::tmpfile();
  if (!file) return "";
  std::fwrite(dot.data(), 1, dot.size(), file);
  std::fflush(file);
  std::rewind(file);
  std::string svg;
  if (std::FILE* const pipe = popen(fmt::format("dot -Tsvg 2>/dev/null <&{}", fileno(file)).c_str(), "r")) {
    char part[4096];
    for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) svg.append(part, n);
    if (pclose(pipe) != 0) svg.clear();
  }
  std::fclose(file);
  const std::size_t begin = svg.find("<svg");
  return begin == std::string::npos ? "" : svg.substr(begin);
}

// The whole plan, and where it has effects, those as one box each.
Json flowOf(const graph::Plan& plan) {
  Json all = Json::array({svgOf(graph::dumpDot(plan))});
  if (std::ranges::any_of(plan.graph->passNames,
                          [](const std::string& name) { return name.find('.') != std::string::npos; }))
    all.push_back(svgOf(graph::dumpDot(plan, true)));
  return all;
}

struct Drawn {
  Json json;
  std::shared_ptr<const graph::Plan> plan;
  assets::Image8 picture;
};

// Runs the frame, and looks at what each step leaves.
std::optional<Drawn> stateOf(gl::Context& context, const Options& options, std::uint32_t repeats,
                             runtime::World& world, text::Diagnostics& diagnostics) {
  runtime::Renderer renderer(context, options.graph, rendererOptionsOf(options));
  text::Diagnostics said;
  const bool loaded = renderer.load(settingsOf(options, context.device().software), world, said);
  diagnostics.append(said);
  if (!loaded || !checkPresents(options, renderer, diagnostics)) return std::nullopt;
  runtime::Execution& execution = *renderer.execution();
  Drawn state;
  state.plan = std::make_shared<const graph::Plan>(execution.plan());
  const std::string all = "*";
  std::vector<runtime::CaptureItem> items = runtime::captureItems(*state.plan, {&all, 1});
  std::vector<std::size_t> count(state.plan->steps.size());
  std::erase_if(items,
                [&](const runtime::CaptureItem& item) { return ++count[item.step] > kPicturesOfStep; });
  Json outputs(state.plan->steps.size(), Json::array());
  runtime::Capture capture(renderer.device());
  for (std::uint64_t number = execution.remembers(world) ? 0 : options.lastFrame; number <= options.lastFrame;
       ++number) {
    const auto frame = static_cast<std::uint32_t>(number);
    if (frame == options.lastFrame)
      capture.start(execution, items, [&](std::size_t i, runtime::Inspector& inspector) {
        if (inspector.picture().id != 0)
          outputs[items[i].step].push_back(outputOf(items[i], inspector, diagnostics));
      });
    drawFrame(renderer, world, options, frame, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
  }
  capture.stop(execution);
  if (auto picture = renderer.readPresented8()) state.picture = *std::move(picture);
  std::vector<std::string> facts{fmt::format("{}x{}", options.width, options.height),
                                 fmt::format("frame {}", options.lastFrame),
                                 withoutFolder(scenePathOf(options)), context.device().renderer};
  for (const std::string& preset : options.presets) facts.push_back(withoutFolder(preset));
  state.json = {{"title", options.graph},
                {"facts", facts},
                {"plan", text::loadJson(graph::dumpJson(*state.plan, true))},
                {"passes", passesOf(*state.plan, renderer.device().sources)},
                {"parameters", parametersOf(*state.plan)},
                {"messages", messagesOf(said)},
                {"outputs", std::move(outputs)},
                {"picture", pictureOf(state.picture)},
                {"flow", flowOf(*state.plan)}};
  if (repeats > 0)
    state.json["times"] = measureSteps(renderer, world, options, options.lastFrame + 1, repeats, diagnostics);
  return state;
}

struct ReportOptions : OtherOptions {
  std::string output;
  std::uint32_t repeats = 0;  // frames to measure; 0: no times
};

int runReport(ReportOptions& options) {
  const Options sides[] = {options, options.otherSide()};
  const auto draw = [&](auto& session, runtime::World& world, text::Diagnostics& diagnostics) {
    const std::span<const Options> drawn(sides, options.hasOther() ? 2 : 1);
    const bool good = writeFramePage(*session->context, options.typed, drawn, options.repeats, options.output,
                                     world, diagnostics);
    if (good) print(text::printable(options.output) + "\n");
    return good ? 0 : 1;
  };
  return options.hasOther() ? runOnDevice({&sides[0], &sides[1]}, 1, draw)
                            : runOnDevice({&sides[0]}, 1, draw);
}

}  // namespace

bool writeFramePage(gl::Context& context, const std::string& command, std::span<const Options> sides,
                    std::uint32_t repeats, const std::string& path, runtime::World& world,
                    text::Diagnostics& diagnostics) {
  Json report{{"command", command}, {"states", Json::array()}};
  std::vector<Drawn> states;
  for (const Options& side : sides) {
    auto state = stateOf(context, side, repeats, world, diagnostics);
    if (!state) return false;
    report["states"].push_back(std::move(state->json));
    states.push_back(*std::move(state));
  }
  if (states.size() > 1) {
    report["difference"] = Json::array();
    std::istringstream lines(graph::diffText(*states[0].plan, *states[1].plan));
    for (std::string line; std::getline(lines, line);) report["difference"].push_back(line);
    if (const auto found = comparePictures(states[1].picture, states[0].picture))
      report["pictures"] = found->bytes.equal() ? "pictures: the same" : "pictures: " + found->text();
  }
  const OutputFile output{"-o", path, OutputFile::Over::file};
  const auto page = pageOf(report, sides[0].graph, diagnostics);
  return page && checkDistinct({&output, 1}, diagnostics) && makeFolderOf(path, diagnostics) &&
         text::writeFile(path, *page, diagnostics);
}

void addReport(CommandLine& line) {
  const auto [command, options] = line.add(
      "report", "write an HTML page of a frame: its steps and resources, what each wrote and why", runReport);
  options.addGraph(command);
  options.addOther(command);
  addPath(command, "-o,--output", options.output, "the page to write, .html")->required();
  options.addFrame(command);
  options.addDrawing(command);
  command.add_option("--times", options.repeats, "also show times: medians over so many frames")
      ->check(CLI::Range(1, 1000));
  command.footer("Example: weft report graphs/studio.json --size 320x180 -o out/report.html");
}

}  // namespace weft::app
