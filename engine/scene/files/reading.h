// What the readers of scene files share: ranges of numbers, vectors, grids, draw lists, messages with a place.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/text/json/fields.h"

namespace weft::scene {

inline constexpr text::NumberRange kUnit{.min = 0, .max = 1};
inline constexpr text::NumberRange kWorld{.min = -1e9, .max = 1e9};  // float keeps 64 units apart there
inline constexpr text::NumberRange kSize{.min = 0, .max = 1e9, .aboveMin = true};
inline constexpr text::NumberRange kAmount{.min = 0, .max = 1e9};

// Reads members in place: one that is absent or wrong stays as it is.
class SceneFields : public text::JsonFields {
 public:
  using JsonFields::JsonFields;
  template <class T>
  void read(std::string_view key, const text::NumberRange& range, T& out) {
    if constexpr (std::is_arithmetic_v<T>) {
      if (const auto number = JsonFields::number(key, range)) out = static_cast<T>(*number);
    } else if (const auto numbers = JsonFields::numbers(key, range, T::length())) {
      out = T(glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]));
    }
  }
  void read(std::string_view key, bool& out) { out = boolean(key).value_or(out); }
};

// The key `lists`: which draw lists something is in, as a mask of maskOf(). Empty when it is absent; W162 for a name that is none.
// `what` names the object in messages.
std::optional<std::uint8_t> readLists(text::JsonFields& fields, const std::string& what,
                                      text::Diagnostics& diagnostics);

// The key `tags`: words of the author's own, by which a graph may choose things.
std::vector<std::string> readTags(text::JsonFields& fields, const std::string& what,
                                  text::Diagnostics& diagnostics);

// The keys `count` and `spacing`, and places around a center row by row, from the upper left one in front.
struct SceneGrid {
  glm::ivec3 count{0};
  float spacing = 2.5f;
  glm::vec3 center{0};

  void read(SceneFields& fields);
  double total() const { return 1.0 * count[0] * count[1] * count[2]; }  // 0: `count` is absent or wrong
  // Calls `put(index, place)`.
  template <class Put>
  void forEach(const Put& put) const {
    std::size_t index = 0;
    const glm::vec3 n(count);
    for (int z = 0; z < count[2]; ++z)
      for (int y = 0; y < count[1]; ++y)
        for (int x = 0; x < count[0]; ++x)
          put(index++,
              center + (glm::vec3(x, -y, -z) - glm::vec3(n.x - 1, 1 - n.y, 1 - n.z) / 2.0f) * spacing);
  }
};

constexpr std::size_t kMaxLamps = 65536;

// The keys `nits`, `sun`, `lamps` and `lamp_grids` of a scene file, with their units. Mistakes: W160, or what JsonFields reports.
void readLights(SceneFields& fields, Scene& scene, text::Diagnostics& diagnostics);

}  // namespace weft::scene
