#include "engine/scene/frame/mesh_frame.h"

#include <algorithm>
#include <cassert>

#include "engine/scene/frame/parallel.h"

namespace weft::scene {

namespace {

constexpr std::size_t kFewRows = 4096, kFewSkins = 64;
constexpr std::size_t kBoxes = 4096;  // that are added up together, on however many threads

// Its joints place it then, and not its node.
bool isSkinned(const Scene& scene, const MeshInstance& instance) {
  return instance.skin.valid() && scene.meshes.rows()[instance.mesh.index].skinned;
}

}  // namespace

void MeshFrame::rebuild(const Scene& scene) {
  firstJoint_.clear();
  jointNodes_.clear();
  skinMoves_.clear();
  for (const Skin& skin : scene.skins.rows()) {
    firstJoint_.push_back(static_cast<std::uint32_t>(jointNodes_.size()));
    bool moves = false;
    for (const NodeId joint : skin.joints) {
      jointNodes_.push_back(joint.index);
      assert(joint.valid() && "joints are nodes of the scene");
      moves = moves || transforms_.isMoving(jointNodes_.back());
    }
    skinMoves_.push_back(moves ? 1 : 0);
  }
  joints_.assign(jointNodes_.size(), {});

  tables_.assign(1, {});
  tables_[0].generation = ++count_;
  tableOf_.clear();
}

bool MeshFrame::isMoving(const Scene& scene, const MeshInstance& instance) const {
  assert(instance.node.valid() && instance.mesh.valid() && instance.material.valid() &&
         "an instance names rows of its scene");
  return transforms_.isMoving(instance.node.index) ||
         (isSkinned(scene, instance) && skinMoves_[instance.skin.index] != 0);
}

void MeshFrame::addList(const Scene& scene, const Selection& list) {
  const Members members(list, scene);
  const std::span<const MeshInstance> all = scene.meshInstances.rows();
  std::vector<std::uint32_t> instances;
  for (std::size_t row = 0; row < all.size(); ++row)
    if (members.has(all[row])) instances.push_back(static_cast<std::uint32_t>(row));
  std::ranges::stable_sort(instances, {}, [&](std::uint32_t row) { return all[row].mesh; });
  auto found = std::ranges::find(tables_, instances, &ListTable::instances);
  if (found == tables_.end()) {
    ListTable& table = tables_.emplace_back();
    for (std::size_t row = 0; row < instances.size(); ++row)
      if (isMoving(scene, all[instances[row]])) table.moving.push_back(static_cast<std::uint32_t>(row));
    table.rows.resize(instances.size());
    table.bounds.resize(instances.size());
    table.instances = std::move(instances);
    found = tables_.end() - 1;
  }
  tableOf_.push_back(static_cast<std::uint32_t>(found - tables_.begin()));
}

void MeshFrame::fillJoints(const Scene& scene, bool all) {
  const bool still = weights_.empty() || scene.animations.size() == 0;
  if (!all && still && std::ranges::find(skinMoves_, 1) == skinMoves_.end()) return;
  jointsGeneration_ = count_;
  weights_ = std::vector<glm::vec2>(scene.weights.begin(), scene.weights.end());
  for (const Animation& each : scene.animations.rows())
    for (std::size_t i = 0; !weights_.empty() && i < each.nodes.size(); ++i)
      if (const assets::ModelTrack& track = each.tracks->tracks[i]; track.path == assets::TrackPath::weights)
        weights_[scene.nodes.rows()[each.nodes[i].index].firstWeight + track.target] = {
            sampleTrack(track, animationTime(each, time_)).x,
            sampleTrack(track, animationTime(each, previousTime_)).x};
  forRanges(skinMoves_.size(), kFewSkins, [&](std::size_t from, std::size_t to) {
    for (std::size_t s = from; s < to; ++s) {
      const std::vector<glm::mat4>& inverseBind = scene.skins.rows()[s].inverseBind;
      for (std::size_t j = 0; (all || skinMoves_[s] != 0) && j < inverseBind.size(); ++j) {
        const std::size_t joint = firstJoint_[s] + j;
        joints_[joint].now = transforms_.now()[jointNodes_[joint]] * inverseBind[j];
        joints_[joint].previous = transforms_.previous()[jointNodes_[joint]] * inverseBind[j];
      }
    }
  });
}

void MeshFrame::fillRow(const Scene& scene, ListTable& table, std::uint32_t row) const {
  const MeshInstance& instance = scene.meshInstances.rows()[table.instances[row]];
  const Mesh& mesh = scene.meshes.rows()[instance.mesh.index];
  MeshRow& out = table.rows[row];
  out.material = instance.material.index;
  out.mesh = instance.mesh.index;
  Box moves{glm::vec3(0), glm::vec3(0)};  // by the morph targets
  if (!mesh.targetBounds.empty()) {
    out.targets = static_cast<std::uint32_t>(mesh.targetBounds.size());
    out.first_target = mesh.firstTarget - mesh.firstVertex * out.targets;
    out.first_weight = scene.nodes.rows()[instance.node.index].firstWeight;
    for (std::uint32_t t = 0; t < out.targets; ++t) {
      const float weight = weights_[out.first_weight + t].x;
      const Box& by = mesh.targetBounds[t];
      moves.low += glm::min(by.low * weight, by.high * weight);
      moves.high += glm::max(by.low * weight, by.high * weight);
    }
  }
  const auto grown = [&](const Box& box) { return Box{box.low + moves.low, box.high + moves.high}; };
  if (!isSkinned(scene, instance)) {
    out.transform = transforms_.now()[instance.node.index];
    out.previous_transform = transforms_.previous()[instance.node.index];
    table.bounds[row] = transformBox(out.transform, grown(mesh.bounds));
    return;
  }
  out.first_joint = firstJoint_[instance.skin.index];
  Box box;
  for (std::size_t j = 0; j < mesh.jointBounds.size(); ++j)
    box.add(transformBox(joints_[out.first_joint + j].now, grown(mesh.jointBounds[j])));
  table.bounds[row] = box;
}

void MeshFrame::fillRows(const Scene& scene, bool another) {
  for (ListTable& table : tables_) {
    const bool all = another || table.generation == 0;
    if (!all && table.moving.empty()) continue;
    forRanges(all ? table.rows.size() : table.moving.size(), kFewRows, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i)
        fillRow(scene, table, all ? static_cast<std::uint32_t>(i) : table.moving[i]);
    });
    table.generation = count_;
  }
}

void MeshFrame::fillBounds(const Scene& scene, double time, bool all) {
  if (all) spheresMove_ = scene::isMoving(scene, Selection());
  const bool moving = std::ranges::any_of(tables_, [](const ListTable& t) { return !t.moving.empty(); });
  if (!all && !moving && !spheresMove_) return;
  if (all || spheresMove_) {
    sphereBounds_ = {};
    for (const Sphere& sphere : scene.spheres.rows()) {
      const glm::vec3 center = sphere.center + sphere.velocity * static_cast<float>(time);
      sphereBounds_.add(Box{center - sphere.radius, center + sphere.radius});
    }
  }
  bounds_ = sphereBounds_;
  for (const ListTable& table : tables_) {
    // In the same parts whatever the number of threads: which of two zeros is least depends on the order.
    partBoxes_.assign((table.bounds.size() + kBoxes - 1) / kBoxes, Box{});
    forRanges(partBoxes_.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from * kBoxes; i < std::min(to * kBoxes, table.bounds.size()); ++i)
        partBoxes_[i / kBoxes].add(table.bounds[i]);
    });
    for (const Box& box : partBoxes_) bounds_.add(box);
  }
}

void MeshFrame::fillLights(const Scene& scene, bool all) {
  const std::span<const Lamp> lamps = scene.lamps.rows();
  if (all) {
    lamps_.assign(lamps.begin(), lamps.end());
    sun_ = scene.sun;
    const auto moves = [&](NodeId node) { return node.valid() && transforms_.isMoving(node.index); };
    lightsMove_ = (sun_ && moves(sun_->node)) || std::ranges::any_of(lamps, moves, &Lamp::node);
  }
  if (!all && !lightsMove_) return;
  lightsGeneration_ = count_;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    if (!lamps[i].node.valid()) continue;
    const glm::mat4& node = transforms_.now()[lamps[i].node.index];
    lamps_[i].position = glm::vec3(node * glm::vec4(lamps[i].position, 1));
    lamps_[i].direction = turnDirection(node, lamps[i].direction);
  }
  if (sun_ && sun_->node.valid())
    sun_->direction = turnDirection(transforms_.now()[sun_->node.index], scene.sun->direction);
}

void MeshFrame::update(const Scene& scene, std::uint64_t sceneGeneration, double time, double previousTime,
                       std::span<const Selection> chosen) {
  const bool another = sceneGeneration != sceneGeneration_;
  const std::size_t lists = kDrawListCount + chosen.size();
  if (!another && time == time_ && previousTime == previousTime_ && lists == tableOf_.size()) return;
  time_ = time;
  previousTime_ = previousTime;
  transforms_.update(scene, sceneGeneration, time, previousTime);
  ++count_;
  if (another) rebuild(scene);
  while (tableOf_.size() < lists) {
    const std::size_t list = tableOf_.size();
    addList(scene,
            list < kDrawListCount ? Selection(static_cast<DrawList>(list)) : chosen[list - kDrawListCount]);
  }
  fillJoints(scene, another);
  fillRows(scene, another);
  fillBounds(scene, time, another);
  fillLights(scene, another);
  sceneGeneration_ = sceneGeneration;
}

}  // namespace weft::scene
