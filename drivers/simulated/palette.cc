#include "drivers/simulated/palette.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/simulated/canvas.h"
#include "drivers/simulated/tint.h"

namespace sparsight::simulated {
namespace {

Texture noise_texture(int size, int coarsest, float falloff, std::uint64_t seed) {
  std::vector<float> values = cloud_noise(size, coarsest, falloff, seed);
  for (float& value : values) value = 0.5F + 0.5F * value;
  return {size, size, values};
}

// Rectangles of varied tone with joints between them; every second row set off by `shift`.
Texture masonry(int size, int columns, int rows, float joint_px, float tone, float vary,
                float joint, float shift, Random& random) {
  Canvas canvas(size, size, joint);
  const float gap = joint_px / static_cast<float>(size);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float value = std::clamp(tone + vary * random.uniform_f(-1, 1), 0.02F, 0.95F);
      const float x = (static_cast<float>(column) + (row % 2 != 0 ? shift : 0.0F)) /
                      static_cast<float>(columns);
      const float y = static_cast<float>(row) / static_cast<float>(rows);
      const float right = x + 1.0F / static_cast<float>(columns);
      canvas.rectangle(x + gap, y + gap, right, y + 1.0F / static_cast<float>(rows), value);
      if (right > 1.0F) {  // what the right edge cuts off comes in again at the left
        canvas.rectangle(0.0F, y + gap, right - 1.0F, y + 1.0F / static_cast<float>(rows), value);
      }
    }
  }
  canvas.weather(16, 0.8F, 0.18F, random.bits());
  return canvas.texture();
}

}  // namespace

Palette::Palette(MaterialLibrary& library, Random& random) : library_(library), random_(random) {
  stain_ = library.add(noise_texture(1024, 4, 0.68F, random.bits()));
  grain_ = library.add(noise_texture(1024, 16, 0.86F, random.bits()));
  coarse_ = library.add(noise_texture(512, 16, 0.72F, random.bits()));
}

int Palette::plain(float albedo, float stain, float grain, int reflectivity) {
  Material material;
  material.albedo = albedo;
  material.stain = stain_;
  material.stain_m = random_.uniform_f(5.0, 8.0);
  material.stain_gain = stain;
  material.detail = grain_;
  material.detail_m = random_.uniform_f(1.0, 1.5);
  material.detail_gain = grain;
  material.reflectivity = static_cast<std::uint8_t>(reflectivity);
  material.tint = tint(40.0F, 0.08F);  // a little warm
  return library_.add(material);
}

int Palette::tinted(int material, float hue_deg, float saturation) {
  library_.materials[static_cast<std::size_t>(material)].tint = tint(hue_deg, saturation);
  return material;
}

// By the count of materials, not by a draw: a place is the same in grey and in colour.
int Palette::tinted_by_turns(int material, std::initializer_list<float> hues_deg,
                             float saturation) {
  const std::size_t turn = static_cast<std::size_t>(material) % hues_deg.size();
  return tinted(material, *(hues_deg.begin() + turn), saturation);
}

int Palette::pattern(Texture texture, Eigen::Vector2f size_m, float stain, float grain,
                     int reflectivity) {
  const int index = plain(1.0F, stain, grain, reflectivity);
  Material& material = library_.materials[static_cast<std::size_t>(index)];
  material.pattern = library_.add(std::move(texture));
  material.pattern_m = size_m;
  return index;
}

int Palette::lamp(float emission) {
  Material material;
  material.albedo = 1.0F;
  material.emission = emission;
  material.reflectivity = 30;
  material.dropout = 0.05F;
  material.tint = tint(45.0F, 0.06F);
  return library_.add(material);
}

int Palette::window(float emission) {
  Canvas canvas(256, 256, 0.5F);
  canvas.photograph(0.0F, 0.0F, 1.0F, 0.45F, random_);
  canvas.rectangle(0.0F, 0.45F, 1.0F, 1.0F, 0.85F);
  canvas.weather(4, 0.6F, 0.2F, random_.bits());
  canvas.outline(0.0F, 0.0F, 1.0F, 1.0F, 0.04F, 0.25F);
  canvas.rectangle(0.48F, 0.0F, 0.52F, 1.0F, 0.25F);
  const int index = pattern(canvas.texture(), {1.0F, 1.4F}, 0.05F, 0.03F, 8);
  library_.materials[static_cast<std::size_t>(index)].emission = emission;
  library_.materials[static_cast<std::size_t>(index)].dropout = 0.75F;
  return tinted(index, 212.0F, 0.2F);
}

int Palette::glass() {
  Canvas canvas(256, 256, 0.1F);
  canvas.photograph(0.0F, 0.0F, 1.0F, 1.0F, random_);
  canvas.weather(4, 0.6F, 0.3F, random_.bits());
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) canvas.at(x, y) = 0.05F + 0.2F * canvas.at(x, y);
  }
  canvas.outline(0.0F, 0.0F, 1.0F, 1.0F, 0.035F, 0.62F);
  canvas.rectangle(0.48F, 0.0F, 0.52F, 1.0F, 0.62F);
  canvas.rectangle(0.0F, 0.68F, 1.0F, 0.71F, 0.62F);
  const int index = pattern(canvas.texture(), {1.2F, 1.5F}, 0.05F, 0.02F, 10);
  library_.materials[static_cast<std::size_t>(index)].dropout = 0.7F;
  return tinted(index, 200.0F, 0.3F);
}

int Palette::bricks() {
  return tinted(pattern(masonry(512, 4, 12, 5.0F, 0.36F, 0.11F, 0.55F, 0.5F, random_), {1.0F, 0.9F},
                        0.15F, 0.12F, 35),
                14.0F, 0.55F);
}

int Palette::floor_tiles(float tile_m, float light, float joint) {
  return tinted(pattern(masonry(512, 4, 4, 2.0F, light, 0.05F, joint, 0.0F, random_),
                        {4.0F * tile_m, 4.0F * tile_m}, 0.16F, 0.14F, 30),
                34.0F, 0.14F);
}

int Palette::boards() {
  Canvas canvas(1024, 512, 0.2F);
  for (int row = 0; row < 8; ++row) {
    const float split = random_.uniform_f(0.2, 0.8);
    const float low = static_cast<float>(row) / 8.0F + 0.003F;
    const float high = static_cast<float>(row + 1) / 8.0F;
    canvas.rectangle(0.0F, low, split, high, random_.uniform_f(0.3, 0.48));
    canvas.rectangle(split + 0.002F, low, 0.999F, high, random_.uniform_f(0.3, 0.48));
  }
  // Grain runs along the boards: noise squeezed across.
  const std::vector<float> noise = cloud_noise(1024, 64, 0.7F, random_.bits());
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 1024; ++x) {
      canvas.at(x, y) *= 1.0F + 0.22F * noise[static_cast<std::size_t>((2 * y) * 1024 + x / 12)];
    }
  }
  return tinted(pattern(canvas.texture(), {2.4F, 1.1F}, 0.15F, 0.08F, 32), 28.0F, 0.5F);
}

int Palette::ceiling_panels() {
  return tinted(pattern(masonry(512, 2, 2, 3.0F, 0.78F, 0.02F, 0.4F, 0.0F, random_), {1.2F, 1.2F},
                        0.05F, 0.10F, 60),
                50.0F, 0.04F);
}

int Palette::door(Eigen::Vector2f size_m) {
  const float tone = random_.uniform_f(0.22, 0.55);
  Canvas canvas(256, 512, tone);
  const std::vector<float> noise = cloud_noise(512, 32, 0.72F, random_.bits());
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 256; ++x) {
      canvas.at(x, y) *= 1.0F + 0.16F * noise[static_cast<std::size_t>((y / 10) * 512 + 2 * x)];
    }
  }
  if (random_.chance(0.4)) {  // a pane
    canvas.rectangle(0.3F, 0.55F, 0.7F, 0.9F, 0.08F);
    canvas.outline(0.29F, 0.545F, 0.71F, 0.905F, 0.012F, tone * 0.6F);
  } else {
    canvas.outline(0.14F, 0.08F, 0.86F, 0.44F, 0.008F, tone * 0.65F);
    canvas.outline(0.14F, 0.5F, 0.86F, 0.93F, 0.008F, tone * 0.65F);
  }
  canvas.rectangle(0.03F, 0.01F, 0.97F, 0.06F, 0.5F);  // kick plate
  canvas.rectangle(0.86F, 0.43F, 0.94F, 0.53F, 0.7F);  // lock
  canvas.rectangle(0.76F, 0.485F, 0.93F, 0.497F, 0.15F);
  canvas.rectangle(0.4F, 0.72F, 0.6F, 0.75F, 0.85F);  // its number
  canvas.print(0.42F, 0.722F, 0.58F, 0.748F, 1, 0.1F, random_);
  return tinted_by_turns(pattern(canvas.texture(), size_m, 0.06F, 0.05F, 40),
                         {28.0F, 214.0F, 26.0F, 150.0F}, 0.4F);
}

void Palette::paint_poster(Canvas& canvas) {
  const float paper = random_.uniform_f(0.72, 0.9);
  const float ink = random_.uniform_f(0.04, 0.2);
  canvas.rectangle(0.0F, 0.0F, 1.0F, 1.0F, paper);
  switch (random_.index(4)) {
    case 0:
      canvas.photograph(0.05F, 0.35F, 0.95F, 0.95F, random_);
      canvas.print(0.08F, 0.24F, 0.9F, 0.33F, 1, ink, random_);
      canvas.print(0.08F, 0.06F, 0.92F, 0.22F, 5, ink + 0.15F, random_);
      break;
    case 1:
      canvas.rectangle(0.0F, 0.75F, 1.0F, 1.0F, random_.uniform_f(0.1, 0.4));
      canvas.print(0.08F, 0.8F, 0.92F, 0.95F, 1, 0.9F, random_);
      canvas.print(0.08F, 0.06F, 0.46F, 0.7F, 14, ink, random_);
      canvas.photograph(0.54F, 0.35F, 0.92F, 0.7F, random_);
      canvas.print(0.54F, 0.06F, 0.92F, 0.3F, 6, ink, random_);
      break;
    case 2: {
      canvas.photograph(0.0F, 0.0F, 1.0F, 1.0F, random_);
      const Eigen::Vector2f middle{random_.uniform_f(0.3, 0.7), random_.uniform_f(0.5, 0.75)};
      canvas.disc(middle.x(), middle.y(), 0.2F, random_.uniform_f(0.1, 0.9));
      canvas.print(0.08F, 0.08F, 0.9F, 0.2F, 1, 0.92F, random_);
      break;
    }
    default:
      for (int i = 0; i < 9; ++i) {
        const Eigen::Vector2f low{random_.uniform_f(0.04, 0.7), random_.uniform_f(0.04, 0.75)};
        const Eigen::Vector2f size{random_.uniform_f(0.1, 0.26), random_.uniform_f(0.06, 0.2)};
        const Eigen::Vector2f high = low + size;
        canvas.rectangle(low.x(), low.y(), high.x(), high.y(), random_.uniform_f(0.1, 0.95));
      }
      canvas.print(0.06F, 0.84F, 0.94F, 0.95F, 2, ink, random_);
      break;
  }
  canvas.outline(0.0F, 0.0F, 1.0F, 1.0F, 0.015F, random_.chance(0.5) ? 0.12F : 0.8F);
}

int Palette::poster(Eigen::Vector2f size_m) {
  Canvas canvas(256, 512, 0.8F);
  paint_poster(canvas);
  canvas.weather(8, 0.7F, 0.06F, random_.bits());
  return tinted_by_turns(pattern(canvas.texture(), size_m, 0.03F, 0.03F, 55),
                         {8.0F, 44.0F, 205.0F, 330.0F, 150.0F, 28.0F, 232.0F}, 0.4F);
}

int Palette::sign(Eigen::Vector2f size_m, bool reflecting) {
  Canvas canvas(128, 128, random_.uniform_f(0.3, 0.5));
  canvas.outline(0.04F, 0.04F, 0.96F, 0.96F, 0.05F, 0.9F);
  canvas.disc(0.3F, 0.5F, 0.2F, 0.9F);
  canvas.print(0.55F, 0.25F, 0.9F, 0.75F, 3, 0.9F, random_);
  return tinted(pattern(canvas.texture(), size_m, 0.02F, 0.02F, reflecting ? 200 : 60),
                reflecting ? 2.0F : 148.0F, 0.9F);
}

int Palette::cardboard(Eigen::Vector2f size_m) {
  Canvas canvas(128, 128, random_.uniform_f(0.32, 0.5));
  canvas.rectangle(0.46F, 0.0F, 0.54F, 1.0F, 0.62F);  // tape
  canvas.rectangle(0.1F, 0.12F, 0.4F, 0.4F, 0.82F);
  canvas.print(0.13F, 0.15F, 0.37F, 0.37F, 4, 0.1F, random_);
  canvas.weather(8, 0.75F, 0.12F, random_.bits());
  return tinted(pattern(canvas.texture(), size_m, 0.05F, 0.07F, 38), 31.0F, 0.45F);
}

int Palette::slats(float period_m) {
  Canvas canvas(64, 64, 0.62F);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float phase = static_cast<float>(x) / 64.0F;
      canvas.at(x, y) = phase < 0.7F ? 0.72F - 0.2F * std::abs(phase - 0.35F) : 0.16F;
    }
  }
  return tinted(pattern(canvas.texture(), {period_m, period_m}, 0.05F, 0.06F, 50), 45.0F, 0.03F);
}

int Palette::paving() {
  return pattern(masonry(512, 6, 6, 3.0F, 0.42F, 0.05F, 0.24F, 0.5F, random_), {2.4F, 2.4F}, 0.22F,
                 0.2F, 25);
}

int Palette::asphalt() {
  const int index = plain(0.3F, 0.25F, 0.3F, 12);
  library_.materials[static_cast<std::size_t>(index)].detail_m = 0.9F;
  return tinted(index, 225.0F, 0.05F);
}

int Palette::leaves(float albedo) {
  const int index = plain(albedo, 0.25F, 0.2F, 30);
  library_.materials[static_cast<std::size_t>(index)].detail = coarse_;
  library_.materials[static_cast<std::size_t>(index)].dropout = 0.05F;
  return tinted(index, 105.0F, 0.7F);
}

int Palette::bark() {
  Canvas canvas(256, 256, 0.26F);
  const std::vector<float> noise = cloud_noise(256, 16, 0.8F, random_.bits());
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      canvas.at(x, y) *= 1.0F + 0.6F * noise[static_cast<std::size_t>((y / 4) * 256 + x)];
    }
  }
  return tinted(pattern(canvas.texture(), {0.8F, 0.8F}, 0.1F, 0.15F, 22), 28.0F, 0.3F);
}

}  // namespace sparsight::simulated
