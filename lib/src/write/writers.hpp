#pragma once

// One function a format, all of one shape; output.cpp holds their table.

#include "meshcontour/write.hpp"

namespace meshcontour::detail {

void write_csv(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>& notes);
void write_obj(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>& notes);
void write_step(const Result& result, const WriteOptions& options, Sink& sink,
                std::vector<Diagnostic>& notes);
void write_dxf(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>& notes);
void write_svg(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>& notes);
void write_glb(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>& notes);
void write_wrl(const Result& result, const WriteOptions& options, Sink& sink, std::vector<Diagnostic>& notes);
void write_json(const Result& result, const WriteOptions& options, Sink& sink,
                std::vector<Diagnostic>& notes);

/// line, arc, circle, ellipse or bspline.
std::string_view type_name(const Curve& curve);

}  // namespace meshcontour::detail
