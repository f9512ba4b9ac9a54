// Broken and odd files, each with what must come of it; the table follows the list that comes with the files.

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/shared.hpp"
#include "unit/read/webxml_text.hpp"

using namespace meshcontour;
using namespace webxml_text;
namespace fs = std::filesystem;

namespace {

enum class Outcome { Ok, Warn, Fail };

struct Expected {
  Outcome outcome = Outcome::Fail;
  std::string text;  // of the error, or of a warning
  int points = 0, triangles = 0, patches = 0, instances = 0;
};

Expected ok(int points, int triangles, int patches, int instances = 1) {
  return {Outcome::Ok, "", points, triangles, patches, instances};
}

Expected warn(std::string text, int points, int triangles, int patches, int instances = 1) {
  return {Outcome::Warn, std::move(text), points, triangles, patches, instances};
}

Expected fail(std::string text) {
  return {Outcome::Fail, std::move(text), 0, 0, 0, 0};
}

const Expected kCube = ok(8, 12, 6);
const Expected kSquareOk = ok(4, 2, 1);

Expected cube(std::string text, int instances = 1) {
  return warn(std::move(text), 8, 12, 6, instances);
}

const std::map<std::string, Expected> kXml = {
    {"a01_zero_byte", fail("empty file")},
    {"a03_truncated_mid_tag", fail(".xml:51")},
    {"a04_truncated_in_attribute", fail(".xml:17")},
    {"a05_truncated_last_tag", fail("the file ends inside <step-assembly>")},
    {"a07_binary", fail("not webxml")},
    {"a08_utf8_bom", kCube},
    {"a09_utf16le", kCube},
    {"a11_utf16_no_bom", kCube},
    {"a12_crlf", kCube},
    {"a13_cr_only", kCube},
    {"a15_no_declaration", kCube},
    {"a16_comments_pi_cdata", kCube},
    {"a17_comment_double_hyphen", fail("'--' inside a comment")},
    {"a19_undefined_entity", fail("'&nbsp;' is not declared")},
    {"a20_charref_zero", fail("illegal character")},
    {"a21_nul_byte", fail("illegal control character")},
    {"a23_quadratic_blowup", fail("DOCTYPE is refused")},
    {"a24_external_entity", fail("DOCTYPE is refused")},
    {"a25_external_dtd", fail("DOCTYPE is refused")},
    {"a27_attr_default_dtd", fail("DOCTYPE is refused")},
    {"a28_latin1_declared", kCube},
    {"a29_latin1_undeclared", cube("byte 0xe9 is not UTF-8")},
    {"a31_mismatched_tags", fail(".xml:15")},
    {"a32_duplicate_attribute", fail("attribute 'v' is given twice")},
    {"a33_two_roots", fail("a second document element")},
    {"a35_trailing_nuls", cube("zero bytes at the end")},
    {"a36_attr_whitespace", kCube},
    {"a37_deep_nesting_100k", fail("nested deeper than 64")},
    {"a39_huge_attribute", kCube},
    {"a40_huge_p", fail("p needs 3 numbers, found 500003")},
    {"a41_many_attributes", fail("more than 256 attributes")},
    {"a43_namespaces", kCube},
    {"a44_prefixed_elements", fail("the document element is <s:step-assembly>")},
    {"a45_wrong_root", fail("the document element is <svg>")},
    {"a47_lt_in_attr", fail("'<' in an attribute value")},
    {"a48_gt_in_attr", kCube},
    {"a49_text_between", kCube},
};

const std::map<std::string, Expected> kValues = {
    {"b01_index_index_past_the_end", fail(".xml:14: shell id3, f: v: index 99, 4 vertices")},
    {"b02_index_index____count__off_by_one_", fail("index 4, 4 vertices")},
    {"b03_index_negative_index", fail("'-1' is not an index")},
    {"b05_index_index_2_32_2__wraps_to_a_val", fail("index 4294967298, 4 vertices")},
    {"b06_index_2_64_2", fail("index 18446744073709551618, 4 vertices")},
    {"b07_index_24_digit_index", fail("index 99999999999999999999999, 4 vertices")},
    {"b09_index_2_0", fail("'2.0' is not an index")},
    {"b10_index_plus_sign", fail("'+2' is not an index")},
    {"b11_index_exponent", fail("'2e0' is not an index")},
    {"b13_index_two_indices", fail("v needs 3 indices, found 2")},
    {"b14_index_four_indices", fail("v needs 3 indices, found 4")},
    {"b15_index_empty_v", fail("v needs 3 indices, found 0")},
    {"b17_index_commas", fail("v needs 3 indices, found 1")},
    {"b18_index_trailing_junk", fail("'2;' is not an index")},
    {"b19_index_leading_zeros", kSquareOk},
    {"b31_coord_NaN", fail(".xml:10: shell id3, v: p: 'nan'")},
    {"b32_coord_inf", fail("'inf'")},
    {"b33_coord__INFINITY", fail("'-INFINITY'")},
    {"b35_coord_MSVC_NaN", fail("'-1.#IND'")},
    {"b36_coord_MSVC_QNaN", fail("'1.#QNAN'")},
    {"b37_coord_MSVC_inf", fail("'1.#INF'")},
    {"b39_coord_denormal", kSquareOk},
    {"b40_coord_three_digit_exponent", kSquareOk},
    {"b41_coord_minus_zero", kSquareOk},
    {"b43_coord__0_and_1_", kSquareOk},
    {"b44_coord_two_numbers", fail("p needs 3 numbers, found 2")},
    {"b45_coord_four_numbers", fail("p needs 3 numbers, found 4")},
    {"b47_coord_hex_floats", fail("'0x0'")},
    {"b48_coord_trailing_letters", fail("'0abc'")},
    {"b49_coord_Fortran_exponent", fail("'1d0'")},
    {"b51_coord_bare_exponent", fail("'1e'")},
    {"b52_coord_400_digit_integer", fail("is not a finite number")},
    {"b53_coord_1000_digit_fraction", kSquareOk},
    {"b55_coord_far_away_vertex", warn("1e+30 is far", 4, 2, 1)},
    {"b60_unused_nan_vertex", fail("'nan'")},
    {"b61_no_v_attribute", fail("attribute v is missing")},
    {"b63_no_normals", kCube},
    {"b64_one_n", cube("1 corner normals where 3 belong")},
    {"b65_five_n", cube("5 corner normals where 3 belong")},
    {"b67_fn_against_winding", kCube},
    {"b68_bad_colors", cube("is not rrggbb and is not used (5 times)")},
    {"b69_no_colors", kCube},
    {"b71_unit", kCube},
    {"b72_unit", kCube},
    {"b73_unit", kCube},
    {"b75_unit", kCube},
    {"b76_unit", kCube},
    {"b77_unknown_stuff", cube("meta: warning: does not belong here")},
    {"b79_verts_last", kSquareOk},
    {"b80_no_verts", fail("index 0, 0 vertices")},
    {"b81_annotation", cube("a polyline is left out: l needs 3 numbers, found 2")},
};

const std::map<std::string, Expected> kMeshes = {
    {"c01_duplicate_triangle", warn("copy of a triangle", 4, 2, 1)},
    {"c02_duplicate_rotated", warn("copy of a triangle", 4, 2, 1)},
    {"c03_duplicate_reversed", ok(4, 3, 1)},
    {"c05_all_flipped", kCube},
    {"c06_bowtie", ok(5, 2, 1)},
    {"c07_hole_touches_outer", ok(8, 7, 1)},
    {"c09_fin_three_triangles", ok(5, 3, 1)},
    {"c10_fin_across_patches", ok(5, 3, 3)},
    {"c11_moebius", ok(24, 24, 1)},
    {"c13_degenerate_index", warn("triangle with a repeated vertex", 4, 2, 1)},
    {"c14_degenerate_all_same", warn("triangle with a repeated vertex", 4, 2, 1)},
    {"c15_zero_area", ok(5, 4, 1)},
    {"c17_isolated_vertices", ok(6, 2, 1)},
    {"c18_empty_facets", ok(8, 12, 7)},
    {"c19_selfclosed_facets", ok(8, 12, 7)},
    {"c21_verts_only", warn("a shell without triangles", 1, 0, 0)},
    {"c22_single_triangle", ok(3, 1, 1)},
    {"c23_closed_tetra", ok(4, 4, 1)},
    {"c25_two_components", ok(8, 4, 1)},
    {"c26_component_closed_plus_open", ok(16, 22, 1)},
    {"c27_triangle_soup", ok(36, 12, 6)},
    {"c29_coincident_loop_points", ok(7, 6, 1)},
    {"c30_all_points_equal", warn("no triangle of the shell has an area", 4, 2, 1)},
    {"c31_collinear_model", warn("no triangle of the shell has an area", 4, 2, 1)},
    {"c33_huge_scale", kCube},
    {"c34_far_offset", kCube},
    {"c35_flat_model", kSquareOk},
    {"c37_annulus", ok(32, 32, 1)},
    {"c38_66000_vertices", ok(66000, 65998, 1)},
    {"c39_fan_20000", ok(20001, 20000, 1)},
    {"c41_3000_loops_one_patch", ok(9000, 3000, 1)},
    {"c42_key_collision", ok(10005, 3, 2)},
    {"c43_pinched_tube", ok(9, 8, 1)},
    {"c45_opposite_coincident_faces", ok(4, 4, 2)},
    {"c46_negative_zero_index", fail("'-0' is not an index")},
};

const std::map<std::string, Expected> kStructures = {
    {"d01_instances_ok", ok(8, 12, 6, 3)},
    {"d03_child_refs_product", cube("'id1' names no shape")},
    {"d04_child_refs_shell", cube("'id3' names no shape")},
    {"d05_child_self_cycle", fail("shapes contain one another: id2 > id2")},
    {"d07_product_children_cycle", kCube},
    {"d08_exponential_dag", fail("1099511627776 instances, the limit is 1000000")},
    {"d09_million_instances", ok(8, 12, 6, 1'000'000)},
    {"d10_deep_chain_20000", kCube},
    {"d11_xform", cube("a child without xform", 2)},
    {"d12_xform", fail(".xml:5: child: xform needs 16 numbers, found 15")},
    {"d13_xform", fail("xform needs 16 numbers, found 17")},
    {"d15_xform", fail("xform: 'nan'")},
    {"d16_xform", cube("xform collapses its part")},
    {"d17_xform", cube("xform has entries beyond 1e15")},
    {"d19_xform", ok(8, 12, 6, 2)},
    {"d20_xform", ok(8, 12, 6, 2)},
    {"d21_xform", cube("xform is no placement in columns")},
    {"d23_xform", cube("xform is no placement in columns")},
    {"d24_root_missing", cube("no root product")},
    {"d25_root_unknown", cube("'id99' names no product")},
    {"d27_two_roots", ok(16, 24, 12, 2)},
    {"d28_no_product_no_shape", cube("'id1' names no product")},
    {"d29_shell_root", kCube},
    {"d31_shell_ref_missing", cube("'id33' names no shell")},
    {"d32_shell_unreferenced", ok(16, 24, 12)},
    {"d33_duplicate_ids", warn("id 'id3' is given to more than one element", 12, 20, 1)},
    {"d35_missing_ids", cube("<shell> has no id")},
    {"d36_several_shells_shapes", warn("unit 'in 0.025400' beside 'mm 0.001000'", 24, 36, 18, 3)},
    {"d37_order_reversed", kCube},
    {"d39_f_outside_facets", cube("f: warning: does not belong here")},
    {"d40_v_in_facets", cube("<v> does not belong here")},
};

const std::map<std::string, Expected> kSplit = {
    {"split_ok", kCube},
    {"split_href_up",
     fail("split_href_up/index.xml:5: shell id3: reference '../../../../../../../../etc/passwd' refused")},
    {"split_href_abs", fail("reference '/etc/passwd' refused")},
    {"split_href_url", fail("refused: the name is a URL")},
    {"split_href_fileurl", fail("refused: the name is a URL")},
    {"split_href_unc", fail("refused: the name holds a backslash")},
    {"split_href_drive", fail("refused: the name holds a backslash")},
    {"split_href_dev", fail("reference '/dev/zero' refused")},
    {"split_href_dot", fail("reference '.' refused")},
    {"split_href_empty", fail("reference '' refused")},
    {"split_href_pct", fail("do not exist, the first is '%2e%2e/%2e%2e/etc/passwd'")},
    {"split_href_sub", fail("refused: the name leaves or repeats its folder")},
    {"split_href_nul", fail("illegal character")},
    {"split_missing", fail("do not exist, the first is 'shell_id3.xml'")},
    {"split_self", fail("split_self/index.xml: the document element is <step-assembly>")},
    {"split_cycle", fail("split_cycle/a.xml: names a further file")},
    {"split_wrong_root", fail("shell_id3.xml: the document element is <annotation>")},
    {"split_wrong_id", cube("has the id 'id999', not 'id3'")},
    {"split_wrong_size", kCube},
    {"split_trunc", fail("split_trunc/shell_id3.xml:43")},
    {"split_shared", ok(8, 12, 6, 2)},
    {"split_inline_and_href", cube("content and href together")},
    {"split_10000_stubs", fail("10000 of its files do not exist, the first is 'shell_id1000.xml'")},
};

bool has_warnings(const Model& model) {
  return std::ranges::any_of(model.diagnostics,
                             [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::Warning; });
}

void check_model(const Model& model, const Expected& expected) {
  validate(model);
  std::size_t points = 0, triangles = 0, patches = 0;
  for (const Shell& shell : model.shells) {
    points += shell.points.size();
    triangles += shell.triangles.size();
    patches += shell.patches.size();
  }
  CHECK(points == static_cast<std::size_t>(expected.points));
  CHECK(triangles == static_cast<std::size_t>(expected.triangles));
  CHECK(patches == static_cast<std::size_t>(expected.patches));
  CHECK(model.instances.size() == static_cast<std::size_t>(expected.instances));
  CHECK((expected.outcome == Outcome::Warn) == has_warnings(model));
  CHECK_THAT(texts(model.diagnostics), Catch::Contains(expected.text));
  CHECK(model.diagnostics.size() <= 4);
}

void check_file(const fs::path& file, const Expected& expected) {
  INFO(file.string());
  try {
    const Model model = read_model(file);
    CHECK((expected.outcome != Outcome::Fail));
    if (expected.outcome != Outcome::Fail) check_model(model, expected);
  } catch (const Error& error) {
    CHECK((expected.outcome == Outcome::Fail));
    CHECK_THAT(error.what(), Catch::Contains(expected.text));
    CHECK(std::string(error.what()).size() < 400);
    CHECK((error.code() == ErrorCode::BadData || error.code() == ErrorCode::OutOfMemory));
  }
}

void check_table(const std::map<std::string, Expected>& table) {
  for (const auto& [name, expected] : table) {
    check_file(shared_dir() / "hostile" / (name.starts_with("split") ? name + "/index.xml" : name + ".xml"),
               expected);
  }
}

}  // namespace

TEST_CASE("hostile files: XML", "[read][error][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  check_table(kXml);
}

TEST_CASE("hostile files: values", "[read][error][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  check_table(kValues);
}

TEST_CASE("hostile files: meshes", "[read][error][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  check_table(kMeshes);
}

TEST_CASE("hostile files: structures", "[read][error][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  check_table(kStructures);
}

TEST_CASE("hostile files: split models", "[read][error][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  check_table(kSplit);
}

TEST_CASE("hostile files: the tables name every file", "[read][shared]") {
  MESHCONTOUR_NEEDS_SHARED("hostile/EXPECT.md")
  std::set<std::string> present, listed;
  for (const auto& entry : fs::directory_iterator(shared_dir() / "hostile")) {
    if (entry.is_directory() || entry.path().extension() == ".xml")
      present.insert(entry.path().stem().string());
  }
  for (const auto* table : {&kXml, &kValues, &kMeshes, &kStructures, &kSplit}) {
    for (const auto& row : *table) listed.insert(row.first);
  }
  CHECK(listed == present);
}
