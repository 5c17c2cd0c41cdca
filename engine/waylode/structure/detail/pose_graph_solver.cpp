// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <ceres/autodiff_cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/structure/detail/pose_graph.hpp"

// The only place that knows Ceres.
namespace waylode::structure::detail {
namespace {

/// Below this a displacement has no direction, and derivatives of one no meaning.
constexpr double kLeastDisplacement_m = 1e-6;
/// Segments below this many length sigmas are compared as vectors, not by length and direction.
constexpr double kShort_sigma = 5.0;
constexpr int kMaxIterations = 200;
constexpr int kMaxDenseUnknowns = 400;
/// Pivots this much smaller than the greatest count as undetermined.
constexpr double kLeastPivot_ratio = 1e-13;

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

template <typename T>
Vector2<T> displacement(const T* from, const T* to) {
  return {to[0] - from[0], to[1] - from[1]};
}

template <typename T>
bool is_short(const Vector2<T>& way) {
  return way.squaredNorm() < T(kLeastDisplacement_m * kLeastDisplacement_m);
}

/// The angle from direction `zero_rad` to `way`, in (-pi, pi]: smooth where they nearly agree.
template <typename T>
T angle_from(const T& zero_rad, const Vector2<T>& way) {
  using std::atan2;
  using std::cos;
  using std::sin;
  const T along = cos(zero_rad) * way.x() + sin(zero_rad) * way.y();
  const T across = cos(zero_rad) * way.y() - sin(zero_rad) * way.x();
  return atan2(across, along);
}

/// Length and direction of a walked segment. [Zhong2017] 4
struct SegmentResidual {
  SegmentTerm term;

  template <typename T>
  bool operator()(const T* from, const T* to, const T* offset_rad, const T* ratio,
                  T* residual) const {
    const Vector2<T> way = displacement(from, to);
    const T zero_rad = offset_rad[0] + T(term.direction_rad);
    if (term.length_m < kShort_sigma * term.length_sigma_m) {
      using std::cos;
      using std::sin;
      residual[0] = (ratio[0] * way.x() - T(term.length_m) * cos(zero_rad)) / term.length_sigma_m;
      residual[1] = (ratio[0] * way.y() - T(term.length_m) * sin(zero_rad)) / term.length_sigma_m;
      return true;
    }
    if (is_short(way)) return false;
    residual[0] = (ratio[0] * way.norm() - T(term.length_m)) / term.length_sigma_m;
    residual[1] = angle_from(zero_rad, way) / term.direction_sigma_rad;
    return true;
  }
};

struct TieResidual {
  double sigma_m;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    residual[0] = (b[0] - a[0]) / sigma_m;
    residual[1] = (b[1] - a[1]) / sigma_m;
    return true;
  }
};

/// How far a turn is from the nearer right angle, left or right.
struct CornerResidual {
  double sigma_rad;

  template <typename T>
  bool operator()(const T* before, const T* at, const T* after, T* residual) const {
    using std::atan2;
    const Vector2<T> in = displacement(before, at);
    const Vector2<T> out = displacement(at, after);
    if (is_short(in) || is_short(out)) return false;
    const T along = in.dot(out);
    const T left = in.x() * out.y() - in.y() * out.x();
    residual[0] = (left > T(0.0) ? atan2(-along, left) : atan2(along, -left)) / sigma_rad;
    return true;
  }
};

/// How far a line is from an axis, modulo half a turn.
struct AxisResidual {
  double sigma_rad;

  template <typename T>
  bool operator()(const T* from, const T* to, const T* axis_rad, T* residual) const {
    using std::cos;
    using std::sin;
    Vector2<T> way = displacement(from, to);
    if (is_short(way)) return false;
    if (cos(axis_rad[0]) * way.x() + sin(axis_rad[0]) * way.y() < T(0.0)) way = -way;
    residual[0] = angle_from(axis_rad[0], way) / sigma_rad;
    return true;
  }
};

struct DistanceResidual {
  DistanceTerm term;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    const Vector2<T> way = displacement(a, b);
    using std::sqrt;
    // Never quite zero, where a distance has no derivative.
    const T square = way.squaredNorm() + T(kLeastDisplacement_m * kLeastDisplacement_m);
    residual[0] = (sqrt(square) - T(term.metres)) / term.sigma_m;
    return true;
  }
};

/// The scale common to all walks is near one.
struct CommonRatioResidual {
  double sigma_ratio;

  template <typename T>
  bool operator()(const T* common, T* residual) const {
    residual[0] = (common[0] - T(1.0)) / sigma_ratio;
    return true;
  }
};

/// A walk's scale is near the common one. Were each near one by itself, many walks would outvote
/// known distances: what the step length law misses is the same for all.
struct RatioResidual {
  double sigma_ratio;

  template <typename T>
  bool operator()(const T* ratio, const T* common, T* residual) const {
    residual[0] = (ratio[0] - common[0]) / sigma_ratio;
    return true;
  }
};

/// The graph as Ceres sees it. Parameters stay where the graph has them.
class Assembly {
 public:
  Assembly(PoseGraph& graph, const PoseGraphOptions& options) : graph_(&graph) {
    add_unknowns();
    for (const SegmentTerm& term : graph.segments) add(term, options);
    for (const TieTerm& term : graph.ties) {
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<TieResidual, 2, 2, 2>(new TieResidual{term.sigma_m}),
          new ceres::CauchyLoss(options.tie_loss_sigma), node(term.a), node(term.b));
    }
    for (const CornerTerm& term : graph.corners) add(term, options);
    for (const AxisTerm& term : graph.axis_terms) add(term, options);
    for (const DistanceTerm& term : graph.distances) {
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<DistanceResidual, 1, 2, 2>(new DistanceResidual{term}),
          nullptr, node(term.a), node(term.b));
    }
    add_ratios(options);
    problem_.SetParameterBlockConstant(node(graph.fixed_node));
    problem_.SetParameterBlockConstant(&graph.walks[graph.fixed_walk].heading_offset_rad);
    hold_walks_without_segments();
  }

  ceres::Problem& problem() { return problem_; }

  /// The blocks that are not fixed, in the graph's order, and where the columns of each belong in
  /// covariance_of's order (axes and the common ratio behind all others).
  struct Column {
    double* block;
    int size;
    int place;
  };
  std::vector<Column> free_columns() {
    std::vector<Column> columns;
    int place = 0;
    const auto add = [&](double* block, int size) {
      if (!problem_.IsParameterBlockConstant(block)) columns.push_back({block, size, place});
      place += size;
    };
    for (std::size_t i = 0; i < graph_->nodes_m.size(); ++i) add(node(i), 2);
    for (WalkState& walk : graph_->walks) {
      add(&walk.heading_offset_rad, 1);
      add(&walk.reading_ratio, 1);
    }
    for (double& axis_rad : graph_->axes_rad) add(&axis_rad, 1);
    add(&graph_->common_ratio, 1);
    return columns;
  }

 private:
  double* node(std::size_t index) { return graph_->nodes_m[index].data(); }

  void add_unknowns() {
    for (std::size_t i = 0; i < graph_->nodes_m.size(); ++i) problem_.AddParameterBlock(node(i), 2);
    for (WalkState& walk : graph_->walks) {
      problem_.AddParameterBlock(&walk.heading_offset_rad, 1);
      problem_.AddParameterBlock(&walk.reading_ratio, 1);
    }
    for (double& axis_rad : graph_->axes_rad) problem_.AddParameterBlock(&axis_rad, 1);
    problem_.AddParameterBlock(&graph_->common_ratio, 1);
  }

  void add_ratios(const PoseGraphOptions& options) {
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<CommonRatioResidual, 1, 1>(
                                  new CommonRatioResidual{options.scale_sigma_ratio}),
                              nullptr, &graph_->common_ratio);
    for (WalkState& walk : graph_->walks) {
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<RatioResidual, 1, 1, 1>(
                                    new RatioResidual{options.person_sigma_ratio}),
                                nullptr, &walk.reading_ratio, &graph_->common_ratio);
    }
  }

  /// Nothing says where these headed.
  void hold_walks_without_segments() {
    std::vector<bool> walked(graph_->walks.size());
    for (const SegmentTerm& term : graph_->segments) walked[term.walk] = true;
    for (std::size_t w = 0; w < walked.size(); ++w) {
      if (!walked[w]) problem_.SetParameterBlockConstant(&graph_->walks[w].heading_offset_rad);
    }
  }

  void add(const SegmentTerm& term, const PoseGraphOptions& options) {
    WalkState& walk = graph_->walks[term.walk];
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<SegmentResidual, 2, 2, 2, 1, 1>(new SegmentResidual{term}),
        new ceres::HuberLoss(options.segment_loss_sigma), node(term.from), node(term.to),
        &walk.heading_offset_rad, &walk.reading_ratio);
  }

  void add(const CornerTerm& term, const PoseGraphOptions& options) {
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<CornerResidual, 1, 2, 2, 2>(
                                  new CornerResidual{options.corner_sigma_rad}),
                              new ceres::CauchyLoss(1.0), node(term.before), node(term.at),
                              node(term.after));
  }

  void add(const AxisTerm& term, const PoseGraphOptions& options) {
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<AxisResidual, 1, 2, 2, 1>(
                                  new AxisResidual{options.parallel_sigma_rad}),
                              new ceres::CauchyLoss(1.0), node(term.from), node(term.to),
                              &graph_->axes_rad[term.axis]);
  }

  PoseGraph* graph_;
  ceres::Problem problem_;
};

Eigen::MatrixXd dense(const ceres::CRSMatrix& sparse) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    const auto begin = static_cast<std::size_t>(sparse.rows[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(sparse.rows[static_cast<std::size_t>(row) + 1]);
    for (std::size_t i = begin; i < end; ++i) matrix(row, sparse.cols[i]) = sparse.values[i];
  }
  return matrix;
}

}  // namespace

SolveSummary solve(PoseGraph& graph, const PoseGraphOptions& options) {
  Assembly assembly(graph, options);
  ceres::Problem& problem = assembly.problem();
  ceres::Solver::Options solver;
  solver.max_num_iterations = kMaxIterations;
  solver.function_tolerance = 1e-10;
  solver.parameter_tolerance = 1e-10;
  solver.gradient_tolerance = 1e-12;
  solver.num_threads = 1;  // Equal input, equal output.
  solver.logging_type = ceres::SILENT;
  solver.linear_solver_type = problem.NumParameters() <= kMaxDenseUnknowns
                                  ? ceres::DENSE_QR
                                  : ceres::SPARSE_NORMAL_CHOLESKY;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  const int freedom = summary.num_residuals_reduced - summary.num_effective_parameters_reduced;
  return {summary.termination_type == ceres::CONVERGENCE, summary.final_cost,
          static_cast<std::size_t>(std::max(0, freedom))};
}

Eigen::MatrixXd covariance_of(const PoseGraph& graph, const PoseGraphOptions& options) {
  PoseGraph copy = graph;
  Assembly assembly(copy, options);
  const auto columns = assembly.free_columns();
  ceres::Problem::EvaluateOptions evaluate;
  for (const auto& column : columns) evaluate.parameter_blocks.push_back(column.block);
  ceres::CRSMatrix sparse;
  if (!assembly.problem().Evaluate(evaluate, nullptr, nullptr, nullptr, &sparse)) return {};
  const Eigen::MatrixXd jacobian = dense(sparse);
  const Eigen::LDLT<Eigen::MatrixXd> normal(jacobian.transpose() * jacobian);
  const Eigen::VectorXd pivots = normal.vectorD();
  if (normal.info() != Eigen::Success ||
      !(pivots.minCoeff() > kLeastPivot_ratio * pivots.maxCoeff())) {
    return {};
  }
  const Eigen::MatrixXd inverse =
      normal.solve(Eigen::MatrixXd::Identity(jacobian.cols(), jacobian.cols()));

  const auto size = static_cast<Eigen::Index>(2 * graph.nodes_m.size() + 2 * graph.walks.size());
  std::vector<Eigen::Index> places;
  for (const auto& column : columns) {
    for (int i = 0; i < column.size; ++i) places.push_back(column.place + i);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (places[i] >= size || places[j] >= size) continue;
      covariance(places[i], places[j]) =
          0.5 * (inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) +
                 inverse(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)));
    }
  }
  return covariance;
}

}  // namespace waylode::structure::detail
