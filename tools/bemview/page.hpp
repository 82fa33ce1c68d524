#pragma once

#include "output/trajectory_scene.hpp"
#include "survey.hpp"

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

namespace bem {

/// Takes the parts of a page one after another.
using PageSink = std::function<void(const std::string&)>;

/// The data of a page: a description in JSON, and sections of numbers (packing.hpp) in this order:
///
///   scene     times (float64 [frames]); of every body its triangles (uint32 [M x 3]), then poses
///   of
///             all bodies (float32 [bodies x frames x 7]); of every obstacle that is a mesh its
///             vertices (float32), triangles and poses (float32 [frames x 7])
///   frames    for every segment: of every body its positions (prediction.hpp, 3 x 16 bits), then
///             its stored fields (12 bits)
///   series    float32 [frames x components] of every series
///   contacts  uint32 [frames]: rows up to the end of every frame; points and forces, float32
///
/// viewer/recording.js reads it.
class PageData {
 public:
  PageData(const Recording& recording, const Survey& survey, std::string title);

  nlohmann::ordered_json description() const;
  std::string scene() const;
  std::size_t segments() const;
  std::string segment(std::size_t index) const;
  std::string series() const;
  std::string contacts() const;

 private:
  nlohmann::ordered_json bodies_json() const;
  nlohmann::ordered_json fields_json() const;
  nlohmann::ordered_json obstacles_json() const;
  nlohmann::ordered_json series_json() const;
  std::size_t segment_end(std::size_t index) const;

  const Recording& recording_;
  const Survey& survey_;
  std::string title_;
  std::vector<ViewSeries> series_;
  std::vector<RecordedObstacle> obstacles_;
  std::size_t segment_frames_ = 1;
};

/// Writes the page: `shell` is the viewer with the mark kDataMark where the data belong.
void write_page(const PageData& data, const std::string& shell, const PageSink& sink,
                const std::function<void(double)>& progress);

inline constexpr const char* kDataMark = "<!-- data -->";

}  // namespace bem
