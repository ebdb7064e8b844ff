#include "engine/runtime/imports/registry.h"

#include <algorithm>
#include <bit>

#include "engine/runtime/imports/geometry.h"
#include "engine/runtime/imports/lut_texture.h"

namespace weft::runtime {

namespace {

using graph::ImportFacts;
using graph::ImportKind;
using graph::ImportRequest;
using graph::Value;

std::vector<graph::ImportType> importTypes() {
  return {
      {.name = "environment",
       .kind = ImportKind::texture,
       .doc = "The loaded environment, equirectangular RGBA16F with a full mip chain, row 0 at +Y. `@-1`: "
              "the one "
              "shown before.",
       .arguments = {},
       .before = true},
      {.name = "spheres",
       .kind = ImportKind::buffer,
       .doc = "The instances of the draw list `spheres`, in the layout of scene/instances.glsl.",
       .arguments = {},
       .instances = true},
      {.name = "draw_order",
       .kind = ImportKind::buffer,
       .doc = "uvec2(key, index) per instance of `list`, back to front, sorted on the CPU every frame.",
       .arguments =
           {{.name = "list", .initial = Value::text("spheres"), .choices = {}, .doc = "a draw list"},
            {.name = "by", .initial = Value::text("depth"), .choices = {"depth"}, .doc = "what is compared"},
            {.name = "method",
             .initial = Value::text("cpu_radix"),
             .choices = {"cpu_std", "cpu_radix", "gpu_bitonic"},
             .doc = "how; gpu_bitonic leaves the buffer to a graph's own passes"}}},
      {.name = "camera",
       .kind = ImportKind::view,
       .doc = "The scene's camera. Declared under the name `camera` it is the view of every pass.",
       .arguments = {{.name = "jitter",
                      .initial = Value::number(0),
                      .choices = {},
                      .doc = "length of the sub-pixel Halton sequence; 0 for none"},
                     {.name = "focal_length",
                      .initial = Value::number(0),
                      .choices = {},
                      .doc = "of its lens in mm: sets the angle of view; 0 for the scene's angle"},
                     {.name = "sensor_height",
                      .initial = Value::number(24),
                      .choices = {},
                      .doc = "mm that the picture's height stands for"}}},
      {.name = "cube_lut",
       .kind = ImportKind::texture,
       .doc = "A .cube table, 3D or 1D, as an RGBA16F 3D texture for composite/lut.glsl; not there when "
              "`file` is empty.",
       .arguments =
           {{.name = "file", .initial = Value::text(""), .choices = {}, .doc = "path of the .cube file"}}},
      {.name = "cut", .kind = ImportKind::event, .doc = "Changes when the camera jumps.", .arguments = {}},
  };
}

}  // namespace

std::uint32_t fullMips(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max({width, height, 1u})));
}

bool operator==(const WorldFacts& a, const WorldFacts& b) {
  const auto same = [](const WorldFacts::List& x, const WorldFacts::List& y) {
    return x.name == y.name && x.count == y.count;
  };
  return a.environment == b.environment && a.environmentWidth == b.environmentWidth &&
         a.environmentHeight == b.environmentHeight && std::ranges::equal(a.lists, b.lists, same);
}

graph::Registry makeRegistry(const passes::PassRegistry& passTypes, const WorldFacts& facts, LutFiles* luts) {
  graph::Registry registry;
  registry.passTypes = passTypes.reflect();
  registry.imports = importTypes();
  const graph::GeometryArgument subdivision{
      .name = "subdivision", .min = 0, .max = kMaxSubdivision, .initial = 2};
  registry.geometries = {{"quad", {}}, {"octagon", {}}, {"icosphere", {subdivision}}, {"triangle", {}}};
  for (const WorldFacts::List& list : facts.lists) registry.drawLists.push_back(list.name);
  registry.factsOf = [facts, luts](const ImportRequest& request) {
    const auto countOf = [&](const std::string& name) -> double {
      for (const WorldFacts::List& list : facts.lists)
        if (list.name == name) return static_cast<double>(list.count);
      return 0;
    };
    ImportFacts result;
    if (request.type == "environment") {
      result.exists = facts.environment;
      result.fallback = true;  // graphs/daylight.json
      result.format = graph::Format::rgba16f;
      result.width = facts.environmentWidth;
      result.height = facts.environmentHeight;
      result.mips = fullMips(result.width, result.height);
    } else if (request.type == "spheres") {
      result.count = countOf("spheres");
      result.exists = true;
    } else if (request.type == "draw_order") {
      result.count = countOf(request.arguments[0].second.symbol);
      result.bytes = static_cast<std::uint64_t>(std::max(result.count, 1.0)) * 8;
      result.exists = true;
    } else if (request.type == "cube_lut") {
      const std::string& file = request.arguments[0].second.symbol;
      if (file.empty()) return result;
      base::Diagnostics said;
      LutFiles once;
      if (const auto lut = (luts ? *luts : once).get(file, said)) {
        const gl::Extent extent = lutExtent(*lut);
        result.exists = true;
        result.format = graph::Format::rgba16f;
        result.width = extent.width;
        result.height = extent.height;
        result.depth = extent.layers;
      }
      result.problems = said.items();
    } else {
      result.exists = true;
    }
    return result;
  };
  return registry;
}

}  // namespace weft::runtime
