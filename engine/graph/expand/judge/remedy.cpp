#include "engine/graph/expand/judge/remedy.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

std::string whyFalse(const Expr& enabled) {
  std::string text = enabled.text();
  if (enabled.isConstant()) return fmt::format("\"enabled\": {}", text);
  if (text.size() > 80) text = text.substr(0, 80) + "…";
  return fmt::format("enabled: {} is false", text);
}

bool isSwitchedOff(const Model& model, const DisabledPass& disabled) {
  return std::ranges::any_of(model.settings.disables,
                             [&](const Disable& each) { return sourceOf(each) == disabled.why; });
}

std::string otherPresent(Model& model, std::uint32_t missing, std::uint32_t position) {
  Scope& root = model.scopes.front();
  const auto& present = root.desc->present;
  if (!present || present->import || findEntity(model, root, present->name, false) != missing) return {};
  const FlatResource& shape = model.entities[missing].shape;
  const auto fits = [&](const Entity& entity) {
    const FormatInfo& format = infoOf(entity.shape.format);
    return entity.kind == ResourceDesc::Kind::texture && entity.scope == &root && entity.arrayCount == 0 &&
           entity.shape.target == Target::texture_2d && entity.shape.width == shape.width &&
           entity.shape.height == shape.height && format.channels >= 3 && !isDepth(entity.shape.format);
  };
  const Entity* best = nullptr;
  for (const Entity& entity : model.entities)
    if (fits(entity) && entity.shape.hasClear && &entity != &model.entities[missing]) best = &entity;
  for (const WriteRecord& write : model.writes)
    if (write.pass != kNone && write.entity != missing && write.position < position &&
        fits(model.entities[write.entity]))
      best = &model.entities[write.entity];
  if (!best) return {};
  return fmt::format("\"present\": \"{}\" at {}:{}:{}", best->name, *present->place.file, present->place.line,
                     present->place.column);
}

std::string namesToDisable(const std::vector<std::string>& readers, std::string_view writer) {
  if (readers.empty()) return {};
  // What all of them begin with, up to a '.'.
  std::string_view common = std::string_view(readers[0]).substr(0, readers[0].rfind('.') + 1);
  for (const std::string& reader : readers)
    while (!reader.starts_with(common)) common = common.substr(0, common.rfind('.', common.size() - 2) + 1);
  if (readers.size() > 1 && !common.empty() && !writer.starts_with(common))
    return fmt::format("'{}'", common.substr(0, common.size() - 1));
  if (readers.size() > 4) return {};
  std::string names;
  for (std::size_t i = 0; i < readers.size(); ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : i + 1 == readers.size() ? " and " : ", ", readers[i]);
  return names;
}

std::string hintForElement(const std::string& name, std::int64_t element, bool levels) {
  if (element < 0) return fmt::format("write '{}@{}' for an earlier frame", name, element);
  return levels ? fmt::format("a level is '{}.mip[…]'", name) : std::string();
}

}  // namespace weft::graph::expansion
