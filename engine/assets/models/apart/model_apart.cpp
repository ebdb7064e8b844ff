#include "engine/assets/models/apart/model_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "engine/assets/models/apart/model_exchange.h"
#include "engine/assets/models/assimp/model_check.h"
#include "engine/text/apart.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

// How far the process is: 1 to kSteps, then that its answer is whole.
constexpr char kSteps = 100, kAnswered = 101;

std::vector<std::string>& readerCommand() {
  static std::vector<std::string> command;
  return command;
}

// For what is read, until textures are decoded: that has bounds of its own.
std::uint64_t secondsFor(std::size_t bytes) {
  return text::raised(4 + (bytes >> 20));
}
std::uint64_t memoryFor(std::size_t bytes) {
  return text::raised((640ull << 20) + 64 * std::uint64_t{bytes});
}

struct Question {
  std::string path, bytes;
  std::uint64_t limitsRaised = 1;
  std::vector<std::string> rules;  // which files may be read
};

struct Answer {
  Model model;
  bool good = false;
  std::vector<text::Diagnostic> said;
};

template <class A>
void pass(A& a, Question& question) {
  auto& [path, bytes, limitsRaised, rules] = question;
  const auto each = [&](auto&... member) { (pass(a, member), ...); };
  each(path, bytes, limitsRaised, rules);
}

template <class A>
void pass(A& a, Answer& answer) {
  auto& [model, good, said] = answer;
  pass(a, model), pass(a, good), pass(a, said);
}

// Whatever a process whose memory is damaged has answered: what the rest of the program takes for granted of a model.
bool isSound(const Model& model) {
  const auto among = [](std::uint32_t row, const auto& rows) { return row == kNoRow || row < rows.size(); };
  const auto within = [](std::uint64_t first, std::uint64_t count, const auto& all) {
    return first + count <= all.size();
  };
  for (const Texture& texture : model.textures) {
    const Image8* image = texture.image.get();
    if (!image || image->channels != 4 || image->width < 1 || image->height < 1 ||
        image->texels.size() / 4 / static_cast<std::size_t>(image->width) !=
            static_cast<std::size_t>(image->height))
      return false;
  }
  for (Material material : model.materials)
    for (const std::uint32_t* map : material.maps())
      if (!among(*map, model.textures)) return false;
  for (const Mesh& mesh : model.meshes) {
    if (!within(mesh.firstVertex, mesh.vertexCount, model.vertices) ||
        !within(mesh.firstIndex, mesh.indexCount, model.indices))
      return false;
    const auto first = model.indices.begin() + mesh.firstIndex;
    if (!std::all_of(first, first + mesh.indexCount,
                     [&](std::uint32_t index) { return index < mesh.vertexCount; }))
      return false;
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].parent != kNoRow && model.nodes[i].parent >= i) return false;
  for (const ModelInstance& each : model.instances)
    if (each.node >= model.nodes.size() || each.mesh >= model.meshes.size() ||
        each.material >= model.materials.size() || !among(each.skin, model.skins))
      return false;
  for (const ModelSkin& skin : model.skins) {
    if (skin.inverseBind.size() != skin.joints.size()) return false;
    for (const std::uint32_t joint : skin.joints)
      if (joint >= model.nodes.size()) return false;
  }
  for (const auto& animation : model.animations)
    for (const ModelTrack& track : animation->tracks)
      if (track.node >= model.nodes.size()) return false;
  return (model.skin.empty() || model.skin.size() == model.vertices.size()) &&
         (model.colors.empty() || model.colors.size() == model.vertices.size());
}

}  // namespace

void readModelsApart(std::vector<std::string> command) {
  readerCommand() = std::move(command);
}

bool readApart(std::string bytes, ModelFiles& files, const LoadObserver& observer, Diagnostics& diagnostics,
               Model& model) {
  std::vector<std::string> command = readerCommand();
  if (command.empty()) return readFbx(std::move(bytes), files, observer, diagnostics, model);
  command.emplace_back(kModelWord);
  const std::size_t size = bytes.size();
  Question question{files.path(), std::move(bytes), text::limitsRaised(), text::accessRules()};
  Writer writer;
  pass(writer, question);
  double done = 0;
  const text::ApartEnd end =
      text::runApart(std::move(command), writer.made, secondsFor(size), [&](char step) {
        if (step > 0 && step <= kSteps) done = step / static_cast<double>(kSteps);
        return !observer || observer(LoadStage::decoding, done);
      });
  if (observer && !observer(LoadStage::decoding, done)) return false;
  Answer answer;
  const bool answered = end.said.ends_with(kAnswered);
  if (answered) {
    Reader reader(end.made);
    pass(reader, answer);
    answer.good = answer.good && reader.good && isSound(answer.model);
  }
  if (!answered || (!answer.good && answer.said.empty())) {
    text::Diagnostic& d =
        diagnostics.error(text::Code::unreadableModel, files.place(),
                          fmt::format("cannot read model '{}': its reader did not survive it", files.path()));
    d.expected = fmt::format("a sound file, read in {} s of processor time and {} MiB", secondsFor(size),
                             memoryFor(size) >> 20);
    d.found = fmt::format("{}, after {:.1f} s of processor time and with {} MiB", end.how, end.seconds,
                          end.mebibytes);
    d.hint = "export it again, as .glb if you can";
    return false;
  }
  for (text::Diagnostic& each : answer.said) diagnostics.add(std::move(each));
  files.takeOver(answer.model.files);
  model = std::move(answer.model);
  return answer.good;
}

void runModelReader() {
  Question question;
  const std::string input = text::beginApart();
  Reader reader(input);
  pass(reader, question);
  if (!reader.good) text::endApart();
  text::raiseLimits(question.limitsRaised);
  text::takeAccessRules(question.rules);
  text::takeLimits(secondsFor(question.bytes.size()), memoryFor(question.bytes.size()));
  const LoadObserver observer = [](LoadStage, double done) {
    text::sayStep(static_cast<char>(1 + std::clamp(done, 0.0, 1.0) * (kSteps - 1)));
    if (done >= 0.5) text::freeLimits();
    return true;
  };
  Answer answer;
  Diagnostics said;
  ModelFiles files(question.path, said, observer);
  files.count(question.bytes.size(), files.place());
  try {
    answer.good = readFbx(std::move(question.bytes), files, observer, said, answer.model);
  } catch (const std::exception&) {  // out of memory
    text::endApart();
  }
  text::freeLimits();
  answer.model.files = files.files();
  answer.said = said.items();
  Writer writer;
  pass(writer, answer);
  text::endApart(writer.made, kAnswered);
}

}  // namespace weft::assets
