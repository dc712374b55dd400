#pragma once

#include <initializer_list>

#include "drivers/simulated/material.h"
#include "drivers/simulated/random.h"

namespace sparsight::simulated {

// Paints textures and mixes materials; every call adds to the library and returns the material's
// index. Unevenness is shared by all of them.
class Palette {
 public:
  Palette(MaterialLibrary& library, Random& random);

  // One tone with stains of metres and grain of millimetres.
  int plain(float albedo, float stain = 0.06F, float grain = 0.05F, int reflectivity = 45);
  int pattern(Texture texture, Eigen::Vector2f size_m, float stain, float grain, int reflectivity);
  // In another colour (see tint()); gives the material back.
  int tinted(int material, float hue_deg, float saturation);
  // In one of several colours.
  int tinted_by_turns(int material, std::initializer_list<float> hues_deg, float saturation);

  int lamp(float emission);
  int window(float emission);  // daylight through panes with mullions, of one repetition a metre
  int glass();                 // a dark pane seen from outside; returns few firings

  int bricks();
  int floor_tiles(float tile_m, float light, float joint);
  int boards();          // wooden floor
  int ceiling_panels();  // 0.6 m
  int door(Eigen::Vector2f size_m);
  int poster(Eigen::Vector2f size_m);
  int sign(Eigen::Vector2f size_m, bool reflecting);
  int cardboard(Eigen::Vector2f size_m);
  int slats(float period_m);  // radiators, shutters, gratings
  int paving();
  int asphalt();
  int leaves(float albedo);
  int bark();

  int clouds() const { return stain_; }

 private:
  void paint_poster(class Canvas& canvas);

  MaterialLibrary& library_;
  Random& random_;
  int stain_;
  int grain_;
  int coarse_;
};

}  // namespace sparsight::simulated
