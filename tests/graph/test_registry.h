// The pass types and imports that graph tests expand against: what engine/passes and engine/runtime reflect,
// without either. The world behind the imports is a few settable facts.
#pragma once

#include <cstdint>

#include "engine/graph/registry.h"

namespace weft::graph::test {

struct World {
  bool environment = true, sun = true, ground = true;
  double spheres = 100, pointLights = 8, shadowedLights = 2;
};

inline std::vector<PassType> testPassTypes() {
  return {
      {.name = "fullscreen",
       .doc = "one triangle",
       .shader = ShaderShape::fragment,
       .keys = {"raster", "samples", "state", "view", "feedback"},
       .fixedSlots = {}},
      {.name = "compute",
       .doc = "a compute shader",
       .shader = ShaderShape::compute,
       .defaultWriteTexture = Kind::image,
       .keys = {"threads", "view"},
       .fixedSlots = {},
       .indirect = true},
      {.name = "draw",
       .doc = "a draw list",
       .shader = ShaderShape::draw,
       .keys = {"list", "geometry", "instances", "draws", "raster", "samples", "view", "state", "feedback"},
       .fixedSlots = {},
       .indirect = true},
      {.name = "blit",
       .doc = "copies",
       .shader = ShaderShape::none,
       .defaultReadTexture = Kind::copy,
       .defaultWriteTexture = Kind::copy,
       .keys = {},
       .fixedSlots = {{"source", Access::read, "", FixedSlot::Takes::either},
                      {"destination", Access::write, "", FixedSlot::Takes::either}},
       .framebuffers = true},
      {.name = "mipmap",
       .doc = "fills levels",
       .shader = ShaderShape::none,
       .defaultReadTexture = Kind::copy,
       .defaultWriteTexture = Kind::copy,
       .keys = {},
       .fixedSlots = {{"source", Access::read, ""}, {"result", Access::write, ""}},
       .fromSource = true},
  };
}

inline ImportArgument argument(const char* name, Value initial, std::vector<std::string> choices = {}) {
  return {name, std::move(initial), std::move(choices), ""};
}

inline ImportArgument drawListArgument() {
  return {.name = "list", .initial = Value::text("spheres"), .choices = {}, .doc = "", .drawList = true};
}

inline ImportArgument viewArgument() {
  return {.name = "view", .initial = Value::text(""), .choices = {}, .doc = "", .view = true};
}

inline ImportArgument orderArgument() {
  return {.name = "order",
          .initial = Value::text("auto"),
          .choices = {"auto", "front_to_back"},
          .doc = "",
          .ofMeshes = true};
}

inline std::vector<ImportType> testImports() {
  Value grid;
  grid.type = Value::Type::list;
  grid.count = 3;
  grid.v = {21, 21, 3, 0};
  return {
      {.name = "environment", .kind = ImportKind::texture, .doc = "", .arguments = {}},
      {.name = "camera",
       .kind = ImportKind::view,
       .doc = "",
       .arguments = {argument("jitter", Value::number(0)), argument("focal_length", Value::number(0)),
                     argument("sensor_height", Value::number(24)), argument("around", Value::number(-1))},
       .columns = {{"position", "vec3", ""},
                   {"direction", "vec3", ""},
                   {"near_plane", "float", ""},
                   {"target_distance", "float", ""},
                   {"view", "mat4", ""}},
       .everyPass = true},
      {"cut", ImportKind::event, "", {}},
      {"mouse", ImportKind::buffer, "", {}},
      {"spheres", ImportKind::buffer, "", {}},
      {"boxes", ImportKind::buffer, "", {}},
      {.name = "sun",
       .kind = ImportKind::buffer,
       .doc = "",
       .arguments = {argument("texels", Value::number(2048)),
                     argument("direction", Value{Value::Type::list, 3, {}, {}}),
                     argument("casting", Value::boolean(false))},
       .columns = {{"direction", "vec3", ""}, {"texel", "float", ""}},
       .views = true},
      {"ground", ImportKind::buffer, "", {}},
      {.name = "lamps",
       .kind = ImportKind::buffer,
       .doc = "",
       .arguments = {argument("casting", Value::boolean(false)), argument("sized", Value::boolean(false))},
       .views = true},
      {.name = "meshes", .kind = ImportKind::buffer, .doc = "", .arguments = {drawListArgument()}},
      {.name = "materials", .kind = ImportKind::buffer, .doc = ""},
      {.name = "material_layers", .kind = ImportKind::buffer, .doc = ""},
      {.name = "joints", .kind = ImportKind::buffer, .doc = ""},
      {.name = "morph_weights", .kind = ImportKind::buffer, .doc = ""},
      {.name = "morph_targets", .kind = ImportKind::buffer, .doc = ""},
      {.name = "vertex_colors", .kind = ImportKind::buffer, .doc = ""},
      {.name = "second_uvs", .kind = ImportKind::buffer, .doc = ""},
      {.name = "material_maps", .kind = ImportKind::texture, .doc = "", .array = 8},
      {"point_lights", ImportKind::list, "", {}},
      {"shadowed_lights", ImportKind::view, "", {}},
      {"draw_order",
       ImportKind::buffer,
       "",
       {drawListArgument(), argument("by", Value::text("power"), {"power", "depth"}),
        argument("method", Value::text("cpu_radix"), {"cpu_std", "cpu_radix", "gpu_bitonic"}),
        viewArgument()}},
      {"draw_list",
       ImportKind::list,
       "",
       {argument("of", Value::text("all"), {"all", "opaque", "spheres"}), argument("name", Value::text("")),
        argument("tag", Value::text("")), argument("material_name", Value::text("")), orderArgument()}},
      {"cube_lut", ImportKind::texture, "", {argument("file", Value{})}},
      {"image",
       ImportKind::texture,
       "",
       {argument("file", Value::text("")), argument("frame", Value::number(-1)),
        argument("fps", Value::number(0)), argument("end", Value::text("loop"), {"loop", "hold"}),
        argument("srgb", Value::boolean(false)), argument("mips", Value::boolean(false))}},
      {"probes",
       ImportKind::buffer,
       "",
       {drawListArgument(), argument("grid", grid), argument("near", Value::number(1)),
        argument("far", Value::number(3)), argument("lobe", Value::text("cap"), {"cap", "point"}),
        argument("shape", Value::text("cap"), {"cap", "point"}),
        argument("window", Value::text("smooth"), {"smooth", "hard"})}},
      {"screen_view", ImportKind::view, "", {}},
  };
}

inline ImportFacts testFacts(const World& world, const ImportRequest& request) {
  ImportFacts facts;
  facts.exists = true;
  if (request.type == "environment") {
    facts.exists = world.environment;
    facts.format = Format::rgba16f;
    facts.width = 2048;
    facts.height = 1024;
    facts.mips = 12;
  } else if (request.type == "material_layers") {
    facts.exists = false;
  } else if (request.type == "material_maps") {
    facts.format = Format::rgba8;
    facts.layered = true;
  } else if (request.type == "meshes" || request.type == "lamps") {
    facts.count = 2;
  } else if (request.type == "cube_lut") {
    facts.exists = !request.arguments[0].second.symbol.empty();
    facts.format = Format::rgba16f;
    facts.width = facts.height = facts.depth = 33;
  } else if (request.type == "image") {
    facts.exists = !request.arguments[0].second.symbol.empty();
    facts.format = Format::rgba8;
    facts.width = 64;
    facts.height = 32;
    facts.mips = request.arguments[5].second.truth() ? 7 : 1;
    facts.changing = request.arguments[0].second.symbol.find("##") != std::string::npos;
    if (request.at("fps").v[0] < 0) {
      text::Diagnostic problem;  // as the import says it: without a place
      problem.code = text::Code::badImportArgument;
      problem.message = "\"fps\" is below 0";
      problem.expected = "pictures per second, or 0 for one per frame";
      problem.found = toText(request.at("fps"));
      facts.problems.push_back(problem);
    }
  } else if (request.type == "spheres") {
    facts.count = world.spheres;
    facts.bytes = 4800;
  } else if (request.type == "draw_list") {
    facts.count = request.at("tag").symbol == "rare" ? 0 : 3;
    facts.exists = facts.count > 0;
  } else if (request.type == "draw_order") {
    facts.count = world.spheres;
    facts.bytes = 800;
  } else if (request.type == "sun") {
    facts.exists = world.sun;
    facts.count = 1;
  } else if (request.type == "ground") {
    facts.exists = world.ground;
    facts.count = 1;
  } else if (request.type == "point_lights") {
    facts.count = world.pointLights;
  } else if (request.type == "shadowed_lights") {
    facts.exists = world.shadowedLights > 0;
    facts.count = world.shadowedLights;
  }
  return facts;
}

inline Registry testRegistry(const World& world = {}) {
  Registry registry;
  registry.passTypes = testPassTypes();
  registry.imports = testImports();
  registry.drawLists = {"spheres",      "opaque", "shadow_casters", "transparent_spheres", "transparent",
                        "transmissive", "ui"};
  registry.geometries = {{"quad", {}},
                         {"icosphere", {{"subdivision", 0, 6, 2}}},
                         {"mesh", {}, true},
                         {"octagon", {}},
                         {.name = "points", .arguments = {{"vertices", 0, 2147483647}}, .counted = 1},
                         {.name = "lines", .arguments = {{"vertices", 0, 2147483647}}, .counted = 2},
                         {.name = "triangles", .arguments = {{"vertices", 0, 2147483647}}, .counted = 3},
                         {"triangle", {}}};
  registry.factsOf = [world](const ImportRequest& request) { return testFacts(world, request); };
  return registry;
}

}  // namespace weft::graph::test
