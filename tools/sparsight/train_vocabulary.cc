#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "slam/loop/loop_config.h"
#include "slam/loop/orb_features.h"
#include "slam/loop/vocabulary_training.h"
#include "tools/loop/training_images.h"
#include "tools/session/atomic_file.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

const std::map<std::string, SimulatedScene> kTrainingScenes{{"corridor", SimulatedScene::kCorridor},
                                                            {"hall", SimulatedScene::kHall},
                                                            {"street", SimulatedScene::kStreet}};

struct TrainArguments {
  std::vector<std::string> folders;
  std::vector<SimulatedScene> scenes;
  RenderingPlan rendering;
  VocabularyTrainingConfig training;
  int features = LoopConfig{}.features;
  std::string output;
};

Result<std::vector<GreyImage>> images_for(const TrainArguments& arguments) {
  std::vector<GreyImage> images;
  for (const std::string& folder : arguments.folders) {
    auto found = images_in_folder(folder);
    if (!found) return found;
    images.insert(images.end(), found->begin(), found->end());
  }
  for (const SimulatedScene scene : arguments.scenes) {
    RenderingPlan plan = arguments.rendering;
    plan.scene = scene;
    const std::vector<GreyImage> seen = rendered_images(plan);
    images.insert(images.end(), seen.begin(), seen.end());
  }
  return images;
}

int train(const TrainArguments& arguments) {
  if (arguments.folders.empty() && arguments.scenes.empty()) {
    std::fputs("sparsight train-vocabulary: give folders with images, or --scene\n", stderr);
    return 2;
  }
  const auto images = images_for(arguments);
  if (!images) {
    std::fprintf(stderr, "sparsight train-vocabulary: %s\n", images.error().message.c_str());
    return 1;
  }
  std::vector<ImageDescriptors> descriptors;
  std::size_t count = 0;
  for (const GreyImage& image : *images) {
    descriptors.push_back(orb_features(image, {.features = arguments.features}).descriptors);
    count += descriptors.back().size();
  }
  const Vocabulary vocabulary = train_vocabulary(descriptors, arguments.training);
  const std::string bytes = vocabulary.to_bytes();
  if (const auto written = write_file(arguments.output, bytes); !written) {
    std::fprintf(stderr, "sparsight train-vocabulary: %s\n", written.error().message.c_str());
    return 1;
  }
  std::printf("%zu images, %zu descriptors, %zu words; %s, %zu bytes\n", images->size(), count,
              vocabulary.words(), arguments.output.c_str(), bytes.size());
  return 0;
}

}  // namespace

void add_train_vocabulary(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<TrainArguments>();
  CLI::App* command = app.add_subcommand(
      "train-vocabulary", "Train the words by which places are recognised, from images");
  command->add_option("FOLDER", arguments->folders, "folders with PNG or JPEG images");
  command
      ->add_option("--scene", arguments->scenes,
                   "also images rendered in a simulated scene; may be given several times")
      ->transform(CLI::CheckedTransformer(kTrainingScenes, CLI::ignore_case)
                      .description("{corridor,hall,street}"));
  command->add_option("--duration", arguments->rendering.duration_s, "seconds in each scene")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command->add_option("--rate", arguments->rendering.rate_hz, "images per second of a scene")
      ->check(CLI::Range(0.5, 30.0))
      ->capture_default_str();
  command->add_option("--branches", arguments->training.branches, "children of a node")
      ->check(CLI::Range(2, 64))
      ->capture_default_str();
  command->add_option("--levels", arguments->training.levels, "levels of the tree")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  command->add_option("--features", arguments->features, "ORB features per image")
      ->check(CLI::Range(50, 10000))
      ->capture_default_str();
  command->add_option("--seed", arguments->training.seed, "same seed and images, same bytes")
      ->capture_default_str();
  command->add_option("--output", arguments->output, "file to write")->required();
  command->callback([arguments, &exit_code] { exit_code = train(*arguments); });
}

}  // namespace sparsight
