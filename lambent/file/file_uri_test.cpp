#include "lambent/file/file_uri.h"

#include <gtest/gtest.h>

#include <string>

namespace lambent::file {
namespace {

TEST(FileUri, NamesAFile) {
  for (const auto& [uri, path] : {std::pair("file:///home/ball.glb", "/home/ball.glb"),
                                  {"file:/home/ball.glb", "/home/ball.glb"},
                                  {"FILE://LocalHost/ball.glb", "/ball.glb"},
                                  {"file:///a%20b/100%25.glb", "/a b/100%.glb"},
                                  {"file:///%c3%BC/\xc3\xbc", "/\xc3\xbc/\xc3\xbc"},
                                  {"file:///%23%3F", "/#?"},
                                  {"file:///%ff", "/\xff"},
                                  {"file:///", "/"}}) {
    const auto read = pathOfUri(uri);
    ASSERT_TRUE(read) << uri << ": " << read.error().message;
    EXPECT_EQ(read->string(), path) << uri;
  }
}

TEST(FileUri, RefusesWhatIsNoneWithTheRemedy) {
  for (const auto& [uri, says] : {std::pair("https://example.org/ball.glb", "copy it here"),
                                  {"smb://server/ball.glb", "copy it here"},
                                  {"file://server/ball.glb", "another machine"},
                                  {"/home/ball.glb", "not a file of this machine"},
                                  {"", "not a file of this machine"},
                                  {"file:", "does not begin at /"},
                                  {"file://", "does not begin at /"},
                                  {"file:ball.glb", "does not begin at /"},
                                  {"file:///a%2", "hexadecimal"},
                                  {"file:///a%", "hexadecimal"},
                                  {"file:///a%zz", "hexadecimal"},
                                  {"file:///a%-1", "hexadecimal"},
                                  {"file:///a%00b", "byte 0"},
                                  {"file:///a?b", "more than the name"},
                                  {"file:///a#b", "more than the name"}}) {
    const auto read = pathOfUri(uri);
    ASSERT_FALSE(read) << uri;
    EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
    EXPECT_NE(read.error().message.find(says), std::string::npos) << read.error().message;
  }
}

}  // namespace
}  // namespace lambent::file
