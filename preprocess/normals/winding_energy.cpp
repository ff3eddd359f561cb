#include "preprocess/normals/winding_energy.h"

namespace relief {

WindingTerms winding_terms(Eigen::MatrixXf numbers, const SurfacePlaces& places,
                           const Eigen::VectorXf& others) {
  const Eigen::Map<const Eigen::VectorXf> areas(places.areas.data(),
                                                static_cast<Eigen::Index>(places.areas.size()));
  WindingTerms terms;
  terms.number = 2.0F * (numbers.transpose() * areas);
  terms.others = -2.0F * (numbers.transpose() * areas.cwiseProduct(others));
  numbers = areas.cwiseSqrt().asDiagonal() * numbers;
  terms.pairs = Eigen::MatrixXf::Zero(numbers.cols(), numbers.cols());
  terms.pairs.selfadjointView<Eigen::Lower>().rankUpdate(numbers.transpose(), -2.0F);
  terms.pairs.triangularView<Eigen::StrictlyUpper>() = terms.pairs.transpose();
  terms.pairs.diagonal().setZero();
  return terms;
}

}  // namespace relief
