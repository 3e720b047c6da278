#include "lambent/file/extension.h"

#include <gtest/gtest.h>

namespace lambent::file {
namespace {

TEST(Extension, IsTheLastInLowerCase) {
  EXPECT_EQ(extensionOf("Sky.EXR"), ".exr");
  EXPECT_EQ(extensionOf("folder.v2/bunny.tar.Glb"), ".glb");
  EXPECT_EQ(extensionOf("folder.v2/bunny"), "");
  EXPECT_EQ(extensionOf(".hidden"), "");
  EXPECT_EQ(extensionOf("\xc3\x84.\xc3\x84"), ".\xc3\x84");  // bytes beyond ASCII stay
}

}  // namespace
}  // namespace lambent::file
