#include "difference.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "output/trajectory_file.hpp"
#include "scene/location.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace bem {
namespace {

class Comparison {
 public:
  Comparison(const std::string& a, const std::string& b, const DifferenceOptions& options)
      : a_(a, ErrorCode::archive), b_(b, ErrorCode::archive), options_(options) {
    check_times();
    check_bodies();
  }

  std::vector<FieldDifference> run() const {
    std::vector<FieldDifference> out;
    for (const std::string& body : a_.names("/bodies"))
      for (const std::string& field : options_.fields) out.push_back(compare(body, field));
    return out;
  }

 private:
  [[noreturn]] void refuse(const std::string& text) const {
    throw Error(ErrorCode::invalid_input, a_.path() + " and " + b_.path() + ": " + text);
  }

  void check_times() const {
    constexpr double kSame = 1e-9;  // of the last time
    const std::vector<double>&s = a_.times(), &t = b_.times();
    if (s.size() != t.size())
      refuse("they have " + std::to_string(s.size()) + " and " + std::to_string(t.size()) +
             " frames");
    for (std::size_t k = 0; k < s.size(); ++k)
      if (std::abs(s[k] - t[k]) > kSame * std::abs(s.back()))
        refuse("frame " + std::to_string(k) + " is at " + to_text(s[k]) + " s and at " +
               to_text(t[k]) + " s");
  }

  void check_bodies() const {
    const auto check = [&](const TrajectoryFile& file, const TrajectoryFile& other) {
      for (const std::string& body : file.names("/bodies"))
        if (!other.has_body(body)) refuse(other.path() + " has no body " + in_quotes(body));
    };
    check(a_, b_);
    check(b_, a_);
  }

  FieldDifference compare(const std::string& body, const std::string& field) const {
    const std::string path = "/bodies/" + body + "/" + field;
    for (const TrajectoryFile* file : {&a_, &b_})
      if (!file->has(path))
        refuse(file->path() + " has no " + in_quotes(field) + " of the body " + in_quotes(body));
    const Hdf5Dims extents = a_.row_extents(path);
    if (b_.row_extents(path) != extents)
      refuse("the body " + in_quotes(body) + " does not have as many vertices in both");
    FieldDifference out;
    out.body = body;
    out.field = field;
    const std::size_t components = std::accumulate(
        extents.begin() + !extents.empty(), extents.end(), std::size_t(1), std::multiplies<>());
    double scale = 0;
    for (std::size_t k = 0; k < a_.times().size(); ++k) {
      const std::vector<double> x = a_.rows(path, extents, k, k + 1),
                                y = b_.rows(path, extents, k, k + 1);
      for (std::size_t i = 0; i < x.size(); ++i) {
        scale = std::max(scale, std::abs(x[i]));
        const double difference = std::abs(x[i] - y[i]);
        if (difference <= out.largest) continue;
        out.largest = difference;
        out.frame = k;
        out.vertex = i / components;
      }
    }
    out.allowed = options_.absolute + options_.relative * scale;
    return out;
  }

  TrajectoryFile a_, b_;
  const DifferenceOptions& options_;
};

}  // namespace

std::vector<FieldDifference> compare_trajectories(const std::string& a, const std::string& b,
                                                  const DifferenceOptions& options) {
  return Comparison(a, b, options).run();
}

}  // namespace bem
