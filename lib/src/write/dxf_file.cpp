#include "write/dxf_file.hpp"

#include <algorithm>
#include <array>

#include "base/utf8.hpp"

namespace meshcontour::detail {
namespace {

constexpr std::size_t kLongestName = 255;

// One pair of group code and value a line here; on two lines each in the file.
constexpr std::string_view kLineTypes = R"(0 TABLE
2 LTYPE
5 5
330 0
100 AcDbSymbolTable
70 3
0 LTYPE
5 14
330 5
100 AcDbSymbolTableRecord
100 AcDbLinetypeTableRecord
2 ByBlock
70 0
3 
72 65
73 0
40 0.0
0 LTYPE
5 15
330 5
100 AcDbSymbolTableRecord
100 AcDbLinetypeTableRecord
2 ByLayer
70 0
3 
72 65
73 0
40 0.0
0 LTYPE
5 16
330 5
100 AcDbSymbolTableRecord
100 AcDbLinetypeTableRecord
2 Continuous
70 0
3 Solid line
72 65
73 0
40 0.0
0 ENDTAB
)";

constexpr std::string_view kOtherTables = R"(0 TABLE
2 STYLE
5 3
330 0
100 AcDbSymbolTable
70 1
0 STYLE
5 11
330 3
100 AcDbSymbolTableRecord
100 AcDbTextStyleTableRecord
2 Standard
70 0
40 0.0
41 1.0
50 0.0
71 0
42 1.0
3 txt
4 
0 ENDTAB
0 TABLE
2 VIEW
5 6
330 0
100 AcDbSymbolTable
70 0
0 ENDTAB
0 TABLE
2 UCS
5 7
330 0
100 AcDbSymbolTable
70 0
0 ENDTAB
0 TABLE
2 APPID
5 9
330 0
100 AcDbSymbolTable
70 1
0 APPID
5 12
330 9
100 AcDbSymbolTableRecord
100 AcDbRegAppTableRecord
2 ACAD
70 0
0 ENDTAB
0 TABLE
2 DIMSTYLE
5 A
330 0
100 AcDbSymbolTable
70 1
100 AcDbDimStyleTable
71 0
0 DIMSTYLE
105 27
330 A
100 AcDbSymbolTableRecord
100 AcDbDimStyleTableRecord
2 Standard
70 0
0 ENDTAB
0 TABLE
2 BLOCK_RECORD
5 1
330 0
100 AcDbSymbolTable
70 2
0 BLOCK_RECORD
5 1F
330 1
100 AcDbSymbolTableRecord
100 AcDbBlockTableRecord
2 *Model_Space
0 BLOCK_RECORD
5 1B
330 1
100 AcDbSymbolTableRecord
100 AcDbBlockTableRecord
2 *Paper_Space
0 ENDTAB
0 ENDSEC
)";

}  // namespace

std::string dxf_name(std::string_view text) {
  constexpr std::string_view reserved = "<>/\\\":;?*|=`',^";
  std::string out;
  std::size_t characters = 0;
  for (; !text.empty() && characters < kLongestName; ++characters) {
    const auto [code, length] = decode_utf8(text);
    text.remove_prefix(length);
    if (code < 0x20 || (code >= 0x7F && code < 0xA0) || code > 0xFFFF ||
        (code < 0x7F && reserved.find(static_cast<char>(code)) != reserved.npos)) {
      out += '_';
    } else if (code < 0x7F) {
      out += static_cast<char>(code);
    } else {
      fmt::format_to(std::back_inserter(out), "\\U+{:04X}", static_cast<unsigned>(code));
    }
  }
  // Blanks around a name do not survive every reader.
  if (out.starts_with(' ')) out.front() = '_';
  if (out.ends_with(' ')) out.back() = '_';
  return out.empty() ? "_" : out;
}

void DxfFile::tags(std::string_view pairs) {
  while (!pairs.empty()) {
    const std::size_t blank = pairs.find(' '), end = pairs.find('\n');
    out_.print("{}\n{}\n", pairs.substr(0, blank), pairs.substr(blank + 1, end - blank - 1));
    pairs.remove_prefix(end + 1);
  }
}

void DxfFile::real(int code, double number) {
  std::array<char, 32> digits;
  char* end = fmt::format_to(digits.data(), FMT_COMPILE("{}"), number);
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  const bool whole = text.find_first_of(".e") == text.npos;  // some readers tell reals by their point
  out_.compiled(FMT_COMPILE("{}\n{}{}\n"), code, text, whole ? ".0" : "");
}

void DxfFile::point(int code, const Point& p) {
  real(code, p.x());
  real(code + 10, p.y());
  real(code + 20, p.z());
}

Handle DxfFile::entity(std::string_view type, const std::string& layer, Handle owner) {
  out_.print("0\n{}\n5\n{:X}\n", type, ++last_);
  if (open_group_ != 0) out_.print("102\n{{ACAD_REACTORS\n330\n{:X}\n102\n}}\n", open_group_);
  out_.print("330\n{:X}\n100\nAcDbEntity\n8\n{}\n", owner, layer);
  return last_;
}

void DxfFile::header(const Box& box, int unit, double julian_date) {
  const bool imperial = unit == 1 || unit == 2 || unit == 3 || (unit >= 8 && unit <= 10);
  // The next free handle is not known before the end; this one is beyond every file that fits a disk.
  tags("0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1015\n9 $HANDSEED\n5 FFFFFFFF\n9 $DWGCODEPAGE\n3 ANSI_1252\n");
  out_.print("9\n$INSUNITS\n70\n{}\n9\n$MEASUREMENT\n70\n{}\n", unit, imperial ? 0 : 1);
  for (const std::string_view name : {"$TDCREATE", "$TDUPDATE"}) {
    out_.print("9\n{}\n", name);
    real(40, julian_date);
  }
  out_.text("9\n$EXTMIN\n");
  point(10, box.min());
  out_.text("9\n$EXTMAX\n");
  point(10, box.max());
  tags("0 ENDSEC\n0 SECTION\n2 CLASSES\n0 ENDSEC\n");
}

void DxfFile::tables(const Box& box, const std::vector<std::string>& layers) {
  const Point center = box.center();
  tags(
      "0 SECTION\n2 TABLES\n0 TABLE\n2 VPORT\n5 8\n330 0\n100 AcDbSymbolTable\n70 1\n0 VPORT\n5 94\n330 8\n"
      "100 AcDbSymbolTableRecord\n100 AcDbViewportTableRecord\n2 *ACTIVE\n70 0\n10 0.0\n20 0.0\n11 1.0\n21 "
      "1.0\n");
  real(12, center.x());
  real(22, center.y());
  tags(
      "13 0.0\n23 0.0\n14 10.0\n24 10.0\n15 10.0\n25 10.0\n16 0.0\n26 0.0\n36 1.0\n17 0.0\n27 0.0\n37 0.0\n");
  real(40, std::max(1.1 * std::max(box.sizes().y(), box.sizes().x() / 1.34), 1e-9));
  tags(
      "41 1.34\n42 50.0\n43 0.0\n44 0.0\n50 0.0\n51 0.0\n71 0\n72 1000\n73 1\n74 3\n75 0\n76 0\n77 0\n78 "
      "0\n0 ENDTAB\n");
  tags(kLineTypes);
  out_.print("0\nTABLE\n2\nLAYER\n5\n2\n330\n0\n100\nAcDbSymbolTable\n70\n{}\n", layers.size() + 1);
  Handle handle = 0x10;
  const auto layer = [&](std::string_view name) {
    out_.print("0\nLAYER\n5\n{:X}\n330\n2\n100\nAcDbSymbolTableRecord\n100\nAcDbLayerTableRecord\n2\n{}\n",
               handle, name);
    tags("70 0\n62 7\n6 Continuous\n390 F\n");
    handle = ++last_;
  };
  layer("0");
  for (const std::string& name : layers) layer(name);
  tags("0 ENDTAB\n");
  tags(kOtherTables);
}

void DxfFile::blocks() {
  tags("0 SECTION\n2 BLOCKS\n");
  const auto block = [&](std::string_view begin, std::string_view end, std::string_view record,
                         std::string_view name) {
    out_.print("0\nBLOCK\n5\n{}\n330\n{}\n100\nAcDbEntity\n8\n0\n100\nAcDbBlockBegin\n2\n{}\n70\n0\n", begin,
               record, name);
    point(10, Point::Zero());
    out_.print("3\n{}\n1\n\n0\nENDBLK\n5\n{}\n330\n{}\n100\nAcDbEntity\n8\n0\n100\nAcDbBlockEnd\n", name, end,
               record);
  };
  block("20", "21", "1F", "*Model_Space");
  block("1C", "1D", "1B", "*Paper_Space");
  tags("0 ENDSEC\n");
}

void DxfFile::begin(const Box& box, int unit, double julian_date, const std::vector<std::string>& layers) {
  const Box shown = box.isEmpty() ? Box(Point::Zero(), Point::Ones()) : box;
  header(shown, unit, julian_date);
  tables(shown, layers);
  blocks();
  tags("0 SECTION\n2 ENTITIES\n");
}

// Groups without names of their own.
void DxfFile::groups() {
  tags("0 DICTIONARY\n5 D\n330 C\n100 AcDbDictionary\n281 1\n");
  for (std::size_t i = 0; i < groups_.size(); ++i) out_.print("3\n*A{}\n350\n{:X}\n", i + 1, groups_[i].own);
  for (const EntityGroup& group : groups_) {
    out_.print("0\nGROUP\n5\n{:X}\n330\nD\n100\nAcDbGroup\n300\n\n70\n1\n71\n1\n", group.own);
    for (Handle member = group.own + 1; member <= group.last; ++member) out_.print("340\n{:X}\n", member);
  }
}

void DxfFile::end() {
  tags(
      "0 ENDSEC\n0 SECTION\n2 OBJECTS\n0 DICTIONARY\n5 C\n330 0\n100 AcDbDictionary\n281 1\n3 "
      "ACAD_GROUP\n350 D\n"
      "3 ACAD_PLOTSTYLENAME\n350 E\n");
  groups();
  tags(
      "0 ACDBDICTIONARYWDFLT\n5 E\n330 C\n100 AcDbDictionary\n281 1\n3 Normal\n350 F\n"
      "100 AcDbDictionaryWithDefault\n340 F\n0 ACDBPLACEHOLDER\n5 F\n330 E\n0 ENDSEC\n0 EOF\n");
  out_.flush();
}

}  // namespace meshcontour::detail
