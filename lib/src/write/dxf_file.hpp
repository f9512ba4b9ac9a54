#pragma once

// The parts of a DXF R2000 file around its entities. [AutoCAD 2000 DXF Reference]

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_writer.hpp"
#include "meshcontour/model.hpp"

namespace meshcontour::detail {

using Handle = std::uint64_t;

/// A layer's name: at most 255 characters without those that DXF reserves; other than ASCII as \U+XXXX.
std::string dxf_name(std::string_view text);

/// Writes group codes and values, and numbers entities.
class DxfFile {
 public:
  explicit DxfFile(Sink& sink) : out_(sink) {}

  /// Everything before the entities.
  ///
  /// @param layers  texts as dxf_name gives them, each once.
  void begin(const Box& box, int unit, double julian_date, const std::vector<std::string>& layers);
  /// Everything after the entities.
  void end();

  /// Starts an entity in model space.
  Handle entity(std::string_view type, const std::string& layer) { return entity(type, layer, kModelSpace); }
  /// Starts an entity that is part of another.
  Handle entity(std::string_view type, const std::string& layer, Handle owner);
  void marker(std::string_view subclass) { out_.print("100\n{}\n", subclass); }
  void value(int code, long long number) { out_.print("{}\n{}\n", code, number); }
  void real(int code, double number);
  /// Codes code, code + 10, code + 20.
  void point(int code, const Point& p);

  /// Entities from here to end_group() are selected together.
  void begin_group() { groups_.push_back({open_group_ = ++last_, 0}); }
  void end_group() {
    groups_.back().last = last_;
    open_group_ = 0;
  }

 private:
  struct EntityGroup {
    Handle own, last;  // its members follow its own handle
  };

  static constexpr Handle kModelSpace = 0x1F;

  void tags(std::string_view pairs);
  void header(const Box& box, int unit, double julian_date);
  void tables(const Box& box, const std::vector<std::string>& layers);
  void blocks();
  void groups();

  TextWriter out_;
  Handle last_ = 0xFF;  // lower ones are those of the fixed parts
  Handle open_group_ = 0;
  std::vector<EntityGroup> groups_;
};

}  // namespace meshcontour::detail
