#include "lambent/file/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

namespace lambent::file {
namespace {

namespace fs = std::filesystem;

/// TMPDIR for the time of a test.
class TemporaryFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    std::string pattern = testing::TempDir() + "/lambent_folder_test_XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    parent_ = pattern;
    setenv("TMPDIR", pattern.c_str(), 1);
  }
  void TearDown() override {
    before_ ? setenv("TMPDIR", before_->c_str(), 1) : unsetenv("TMPDIR");
    fs::remove_all(parent_);
  }
  std::optional<std::string> before_;
  fs::path parent_;
};

TEST_F(TemporaryFolderTest, GoesWithAllThatIsInIt) {
  {
    auto folder = TemporaryFolder::create();
    ASSERT_TRUE(folder) << folder.error().message;
    EXPECT_EQ(folder->path().parent_path(), parent_);
    struct stat status = {};
    ASSERT_EQ(stat(folder->path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    std::ofstream(folder->place("one")) << "placed";
    std::ofstream(folder->path() / "two") << "not placed";
    const TemporaryFolder moved = std::move(*folder);
    EXPECT_TRUE(fs::exists(moved.path() / "two"));
  }
  EXPECT_TRUE(fs::is_empty(parent_));
}

TEST_F(TemporaryFolderTest, SaysWhatToDoWhereNoneCanBeMade) {
  setenv("TMPDIR", (parent_ / "nowhere").c_str(), 1);
  const auto folder = TemporaryFolder::create();
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().kind, ErrorKind::BadInput);
  EXPECT_NE(folder.error().message.find("TMPDIR names another"), std::string::npos);
}

TEST_F(TemporaryFolderTest, ASignalLeavesNone) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGINT, [](int) {
      TemporaryFolder::discardAll();
      _exit(42);
    });
    auto a = TemporaryFolder::create(), b = TemporaryFolder::create();
    if (!a || !b) _exit(1);
    std::ofstream(a->place("one")) << "placed";
    std::ofstream(a->place("two")) << "placed";
    a->place("never written");
    if (write(ready[1], "r", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char byte;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_FALSE(fs::is_empty(parent_));
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_TRUE(fs::is_empty(parent_));
  close(ready[0]);
  close(ready[1]);
}

TEST_F(TemporaryFolderTest, ThereMayBeMoreOfThemThanSlots) {
  for (int round = 0; round < 3; ++round) {
    auto folder = TemporaryFolder::create();
    ASSERT_TRUE(folder);
    for (int i = 0; i < 40; ++i)
      std::ofstream(folder->place("file" + std::to_string(i))) << "placed";
  }
  EXPECT_TRUE(fs::is_empty(parent_));
}

}  // namespace
}  // namespace lambent::file
