#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "meshcontour/boundary.hpp"
#include "meshcontour/fit.hpp"
#include "meshcontour/render.hpp"
#include "meshcontour/segmentation.hpp"
#include "meshcontour/simplification.hpp"
#include "meshcontour/subdivision.hpp"
#include "meshcontour/sweep.hpp"
#include "meshcontour/write.hpp"
#include "messages.hpp"

namespace meshcontour::app {

/// The words of an option and what they mean; one table serves parsing, help and messages.
template <class T, std::size_t N>
using Choices = std::array<std::pair<std::string_view, T>, N>;

inline constexpr Choices<Layer, 13> kLayers = {{{"mesh", Layer::Mesh},
                                                {"edges", Layer::Edges},
                                                {"curves", Layer::Curves},
                                                {"wireframe", Layer::Wireframe},
                                                {"points", Layer::Points},
                                                {"control", Layer::Control},
                                                {"frames", Layer::Frames},
                                                {"detail", Layer::Detail},
                                                {"annotations", Layer::Annotations},
                                                {"tree", Layer::Tree},
                                                {"path", Layer::Path},
                                                {"axes", Layer::Axes},
                                                {"scale", Layer::Scale}}};
inline constexpr Choices<View, 8> kViews = {{{"iso", View::Iso},
                                             {"front", View::Front},
                                             {"back", View::Back},
                                             {"left", View::Left},
                                             {"right", View::Right},
                                             {"top", View::Top},
                                             {"bottom", View::Bottom},
                                             {"report", View::Report}}};
inline constexpr Choices<UpAxis, 3> kUpAxes = {{{"x", UpAxis::X}, {"y", UpAxis::Y}, {"z", UpAxis::Z}}};
inline constexpr Choices<ColorBy, 5> kColorings = {{{"file", ColorBy::File},
                                                    {"patch", ColorBy::Patch},
                                                    {"number", ColorBy::Number},
                                                    {"layer", ColorBy::Layer},
                                                    {"type", ColorBy::Type}}};
inline constexpr Choices<Shading, 2> kShadings = {{{"smooth", Shading::Smooth}, {"none", Shading::None}}};
inline constexpr Choices<int, 3> kSamples = {{{"1", 1}, {"4", 4}, {"16", 16}}};
inline constexpr Choices<MessageStyle, 2> kMessageStyles = {
    {{"text", MessageStyle::Text}, {"github", MessageStyle::GitHub}}};
inline constexpr Choices<GlBackend, 3> kBackends = {
    {{"auto", GlBackend::Automatic}, {"osmesa", GlBackend::OSMesa}, {"egl", GlBackend::Egl}}};
inline constexpr Choices<Extractor, 2> kExtractors = {
    {{"sorted", Extractor::Sorted}, {"halfedge", Extractor::Halfedge}}};
inline constexpr Choices<FitMethod, 4> kFitMethods = {{{"control", FitMethod::Control},
                                                       {"interpolate", FitMethod::Interpolate},
                                                       {"approximate", FitMethod::Approximate},
                                                       {"primitives", FitMethod::Primitives}}};
inline constexpr Choices<PatchSource, 5> kPatchSources = {{{"auto", PatchSource::Automatic},
                                                           {"file", PatchSource::File},
                                                           {"angle", PatchSource::Angle},
                                                           {"components", PatchSource::Components},
                                                           {"none", PatchSource::None}}};
inline constexpr Choices<BoundaryRule, 2> kBoundaryRules = {
    {{"reflect", BoundaryRule::Reflect}, {"trig", BoundaryRule::Trigonometric}}};
inline constexpr Choices<AttributeRule, 2> kAttributeRules = {
    {{"midpoint", AttributeRule::Midpoint}, {"butterfly", AttributeRule::Butterfly}}};
inline constexpr Choices<SimplifyMethod, 3> kSimplifyMethods = {{{"auto", SimplifyMethod::Automatic},
                                                                 {"wavelet", SimplifyMethod::Wavelet},
                                                                 {"qem", SimplifyMethod::Qem}}};
inline constexpr Choices<SimplifyGoal, 3> kSimplifyGoals = {
    {{"error", SimplifyGoal::Error}, {"ratio", SimplifyGoal::Ratio}, {"triangles", SimplifyGoal::Triangles}}};
inline constexpr Choices<FrameMethod, 3> kFrameMethods = {{{"rmf", FrameMethod::RotationMinimizing},
                                                           {"mit", FrameMethod::Projection},
                                                           {"frenet", FrameMethod::Frenet}}};
inline constexpr Choices<CsvContent, 2> kCsvContents = {
    {{"loops", CsvContent::Loops}, {"curves", CsvContent::Curves}}};
inline constexpr Choices<ObjContent, 4> kObjContents = {{{"polylines", ObjContent::Polylines},
                                                         {"curves", ObjContent::Curves},
                                                         {"tree", ObjContent::Tree},
                                                         {"path", ObjContent::Path}}};
inline constexpr Choices<WrlContent, 2> kWrlContents = {
    {{"tree", WrlContent::Tree}, {"path", WrlContent::Path}}};
inline constexpr Choices<DxfContent, 2> kDxfContents = {
    {{"curves", DxfContent::Curves}, {"polyline", DxfContent::Polyline}}};
inline constexpr Choices<StepSchema, 2> kStepSchemas = {
    {{"ap242", StepSchema::Ap242}, {"ap214", StepSchema::Ap214}}};
inline constexpr Choices<EdgeUse, 2> kEdgeUses = {{{"all", EdgeUse::All}, {"unique", EdgeUse::Unique}}};

/// "mesh, edges, curves"
template <class T, std::size_t N>
std::string words(const Choices<T, N>& choices) {
  std::string out;
  for (const auto& [word, value] : choices) out += (out.empty() ? "" : ", ") + std::string(word);
  return out;
}

/// The word of a value.
template <class T, std::size_t N>
std::string word_of(const Choices<T, N>& choices, T value) {
  for (const auto& [word, candidate] : choices) {
    if (candidate == value) return std::string(word);
  }
  return {};
}

}  // namespace meshcontour::app
