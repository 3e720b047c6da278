#include "lambent/scene_io/curves.h"

#include <gtest/gtest.h>

namespace lambent::scene_io {
namespace {

std::vector<Polyline> curvesIn(std::string_view text, CurveFormat format) {
  auto curves = parseCurves(text, format, "file");
  EXPECT_TRUE(curves) << curves.error().message;
  return curves ? *curves : std::vector<Polyline>();
}

TEST(Curves, OfCsvAreWhatHasOneNameLineAfterLine) {
  const auto curves = curvesIn(
      "curve,x,y,z\r\na, 0,0,0\r\na,1,0,0\n# b is closed\nb,0,1e-1,0\nb,-1,0,+2\n\nb,0,.1,0\n"
      "alone,7,7,7\na,5,5,5\na,6,6,6",
      CurveFormat::Csv);
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[0], (Polyline{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(curves[1], (Polyline{{0, 0.1, 0}, {-1, 0, 2}, {0, 0.1, 0}}));
  EXPECT_EQ(curves[2], (Polyline{{5, 5, 5}, {6, 6, 6}}));
}

TEST(Curves, OfObjAreItsLines) {
  const auto curves = curvesIn(
      "# a\nv 0 0 0\nv 1 0 0 1.0\nvt 0 0\nv 1 1 0\no b\nl 1 2/1 \\\n 3\nf 1 2 3\nl -1 -3\nl 2\n",
      CurveFormat::Obj);
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[0], (Polyline{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(curves[1], (Polyline{{1, 1, 0}, {0, 0, 0}}));
}

void expectRefused(std::string_view text, CurveFormat format, std::string_view says) {
  const auto curves = parseCurves(text, format, "file");
  ASSERT_FALSE(curves) << text;
  EXPECT_EQ(curves.error().kind, ErrorKind::BadInput);
  EXPECT_NE(curves.error().message.find(says), std::string::npos) << curves.error().message;
}

TEST(Curves, SayWhereTheyAreWrong) {
  expectRefused("a,0,0,0\na,0,0\n", CurveFormat::Csv, "file, line 2: should be curve,x,y,z");
  expectRefused("a,0,0,0\na,0,nan,0\n", CurveFormat::Csv, "line 2");
  expectRefused("a,0,0,0\na,0,0,0,0\n", CurveFormat::Csv, "line 2");
  expectRefused("a,0,0,0\nb,1,1,1\n", CurveFormat::Csv, "no curve");
  expectRefused("", CurveFormat::Csv, "no curve");
  expectRefused("v 0 0 0\nl 1 2\n", CurveFormat::Obj, "line 2: there is no vertex 2 among the 1");
  expectRefused("v 0 0 0\nl 1 -2\n", CurveFormat::Obj, "no vertex -2");
  expectRefused("v 0 0\n", CurveFormat::Obj, "line 1");
  expectRefused("v 0 0 0\nv 1 1 1\nf 1 2 1\n", CurveFormat::Obj, "l elements");
}

}  // namespace
}  // namespace lambent::scene_io
