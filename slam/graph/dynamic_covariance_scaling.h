#pragma once

namespace sparsight {

// Dynamic Covariance Scaling (Agarwal, Tipaldi, Spinello, Stachniss and Burgard, "Robust map
// optimization using dynamic covariance scaling", ICRA 2013, eq. (15)): an edge keeps its
// covariance as long as chi^2 <= Phi; beyond, its residual is scaled by
//     s = min(1, 2 Phi / (Phi + chi^2)).
inline double dcs_scale(double chi2, double phi) {
  return chi2 > phi ? 2.0 * phi / (phi + chi2) : 1.0;
}

// The same as a robust cost rho(chi^2) whose weight is s^2, and which a line search may trust: rho'
// integrated from zero. It is bounded by 3 Phi, so that a false loop's pull fades with its error.
struct RobustCost {
  double value;
  double first;   // derivative, s^2
  double second;  // derivative of that
};
inline RobustCost dcs_cost(double chi2, double phi) {
  if (chi2 <= phi) return {chi2, 1.0, 0.0};
  const double s = dcs_scale(chi2, phi);
  return {phi * (3.0 * chi2 - phi) / (chi2 + phi), s * s, -2.0 * s * s / (phi + chi2)};
}

}  // namespace sparsight
