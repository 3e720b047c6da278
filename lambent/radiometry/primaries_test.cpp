#include "lambent/radiometry/primaries.h"

#include <gtest/gtest.h>

#include <limits>

namespace lambent::radiometry {
namespace {

double distance(const Mat3d& a, const Mat3d& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(PrimariesToRec709, AreTheMatricesOfTheirDocuments) {
  // ACES 1.x, AP1 and AP0 to Rec. 709 with D60 adapted to D65 by Bradford's cones.
  Mat3d ap1, ap0, rec2020;
  ap1 << 1.70505, -.62179, -.08326, -.13026, 1.14080, -.01055, -.02400, -.12897, 1.15297;
  ap0 << 2.52169, -1.13413, -.38756, -.27648, 1.37272, -.09624, -.01538, -.15298, 1.16835;
  // ITU-R BT.2087.
  rec2020 << 1.6605, -.5876, -.0728, -.1246, 1.1329, -.0083, -.0182, -.1006, 1.1187;
  EXPECT_LT(distance(*rec709From(*primariesNamed("ACEScg")), ap1), 5e-5);
  EXPECT_LT(distance(*rec709From(*primariesNamed("lin_ap0_scene")), ap0), 5e-5);
  EXPECT_LT(distance(*rec709From(*primariesNamed("Linear Rec.2020")), rec2020), 1e-4);
  EXPECT_LT(distance(*rec709From(rec709Primaries()), Mat3d::Identity()), 1e-12);
}

TEST(PrimariesToRec709, WhiteStaysWhite) {
  for (const char* name : {"ACEScg", "ACES2065-1", "Display P3", "Adobe RGB (1998)", "ProPhoto"}) {
    const Vec3d white = *rec709From(*primariesNamed(name)) * Vec3d::Ones();
    EXPECT_LT((white - Vec3d::Ones()).cwiseAbs().maxCoeff(), 1e-3) << name;
  }
}

TEST(PrimariesToRec709, XyzIsNotAdapted) {
  // IEC 61966-2-1 states its inverse to four places.
  const Mat3d matrix = *rec709From(xyzPrimaries());
  Mat3d srgb;
  srgb << 3.2406, -1.5372, -.4986, -.9689, 1.8758, .0415, .0557, -.2040, 1.0570;
  EXPECT_LT(distance(matrix, srgb), 5e-4);
}

TEST(PrimariesToRec709, WhatIsNoTriangleIsNone) {
  Primaries line = rec709Primaries();
  line.blue = line.red;
  EXPECT_FALSE(rec709From(line));
  Primaries dark = rec709Primaries();
  dark.white.y() = 0;
  EXPECT_FALSE(rec709From(dark));
  Primaries hollow = rec709Primaries();
  hollow.green.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(rec709From(hollow));
  EXPECT_FALSE(primariesNamed("scene_linear"));
}

}  // namespace
}  // namespace lambent::radiometry
