#pragma once

#include "slam/tracking/photometric_kernel.h"
#include "slam/tracking/photometry_config.h"

namespace sparsight {

// The weight function of eq. (5) in its two forms.
//
// Per pixel, as in the paper: each residual has its own t-distribution.
//
// Per patch (PhotometryConfig::patch_weights): the residuals of a patch share one scale, the
// multivariate t-distribution, with
//     w = (nu + n) / (nu + sum r^2 / sigma^2)
// for the n pixels of the patch. A patch on a moving car disagrees as a whole, and loses its weight
// as a whole, while eight pixels taken one by one would each keep a part (Lange, Little and Taylor
// 1989, Sec. 2, for the distribution and its estimation). Precondition: sum_patches().
//
// Each mirrors the function of the same name in photometric_kernel.h.
double estimate_sigma(const Linearization& linearization, const PhotometryConfig& photometry,
                      double sigma_start);
double robust_cost(const Linearization& linearization, const PhotometryConfig& photometry,
                   double sigma);
NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           const PhotometryConfig& photometry, double sigma);

}  // namespace sparsight
