#pragma once

#include <Eigen/Core>

namespace sparsight {

// Central differences about zero; what every analytic Jacobian is compared with. `function` takes a
// vector of `inputs` increments and returns a vector.
template <typename Function>
Eigen::MatrixXd numeric_jacobian(const Function& function, Eigen::Index inputs, double step) {
  Eigen::MatrixXd J;
  for (Eigen::Index i = 0; i < inputs; ++i) {
    const Eigen::VectorXd increment = step * Eigen::VectorXd::Unit(inputs, i);
    const Eigen::VectorXd forward = function(increment);
    const Eigen::VectorXd backward = function(-increment);
    if (i == 0) J.resize(forward.size(), inputs);
    J.col(i) = (forward - backward) / (2.0 * step);
  }
  return J;
}

}  // namespace sparsight
