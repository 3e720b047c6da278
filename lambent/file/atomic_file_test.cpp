#include "lambent/file/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

namespace lambent::file {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "lambent_file_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code ignored;
    fs::permissions(folder_, fs::perms::owner_all, ignored);
    fs::remove_all(folder_, ignored);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_))
      found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }
  using Names = std::vector<std::string>;
  fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsOnlyAtCommit) {
  const fs::path path = folder_ / "a.txt";
  Result<AtomicFile> file = AtomicFile::create(path);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write("hello "));
  ASSERT_TRUE(file->write("world"));
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(file->temporaryPath().parent_path(), folder_);
  EXPECT_EQ(content(file->temporaryPath()), "hello world");
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(path), "hello world");
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFileTest, WithoutCommitTheOldContentStays) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(writeAtomically(path, "old"));
  {
    Result<AtomicFile> file = AtomicFile::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write("new"));
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFileTest, MovedFileCommitsOnce) {
  Result<AtomicFile> file = AtomicFile::create(folder_ / "a");
  ASSERT_TRUE(file);
  {
    AtomicFile moved(std::move(*file));
    ASSERT_TRUE(moved.write("x"));
    ASSERT_TRUE(moved.commit());
  }
  EXPECT_EQ(content(folder_ / "a"), "x");
}

TEST_F(AtomicFileTest, NewFileHonoursTheUmaskAndAnOldOneKeepsItsMode) {
  const mode_t before = umask(027);
  ASSERT_TRUE(writeAtomically(folder_ / "new", "x"));
  umask(before);
  struct stat status;
  ASSERT_EQ(stat((folder_ / "new").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
  ASSERT_EQ(chmod((folder_ / "new").c_str(), 0604), 0);
  ASSERT_TRUE(writeAtomically(folder_ / "new", "y"));
  ASSERT_EQ(stat((folder_ / "new").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0604u);
}

TEST_F(AtomicFileTest, MissingFolderIsNamed) {
  const fs::path path = folder_ / "nowhere" / "a.txt";
  const Status status = checkWritable(path);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadInput);
  EXPECT_NE(status.error().message.find((folder_ / "nowhere").string() + " does not exist"),
            std::string::npos)
      << status.error().message;
  EXPECT_FALSE(writeAtomically(path, "x"));
}

TEST_F(AtomicFileTest, FolderFileAndEmptyNameAreRefused) {
  fs::create_directory(folder_ / "d");
  EXPECT_FALSE(checkWritable(folder_ / "d"));
  EXPECT_FALSE(checkWritable(folder_ / "absent" / ""));
  EXPECT_FALSE(checkWritable(""));
  ASSERT_TRUE(writeAtomically(folder_ / "f", "x"));
  const Status below = checkWritable(folder_ / "f" / "g");
  ASSERT_FALSE(below);
  EXPECT_NE(below.error().message.find("not a folder"), std::string::npos);
  const Result<std::vector<std::byte>> read = readWhole(folder_ / "d");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("it is a folder"), std::string::npos);
}

TEST_F(AtomicFileTest, NoPermission) {
  if (geteuid() == 0) {
    // Root may write anywhere: become nobody in a child.
    ASSERT_EQ(chmod(folder_.c_str(), 0555), 0);
    const pid_t child = fork();
    if (child == 0) {
      if (setuid(65534) != 0) _exit(9);
      const Status status = checkWritable(folder_ / "a");
      _exit(!status && status.error().message.find("no permission") != std::string::npos ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 0);
  } else {
    ASSERT_EQ(chmod(folder_.c_str(), 0555), 0);
    const Status status = checkWritable(folder_ / "a");
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("no permission"), std::string::npos);
  }
}

TEST_F(AtomicFileTest, CheckWritableLeavesNothing) {
  EXPECT_TRUE(checkWritable(folder_ / "a.glb"));
  EXPECT_TRUE(names().empty());
  ASSERT_TRUE(writeAtomically(folder_ / "a.glb", "old"));
  EXPECT_TRUE(checkWritable(folder_ / "a.glb"));
  EXPECT_EQ(content(folder_ / "a.glb"), "old");
}

TEST_F(AtomicFileTest, FullDeviceSaysSo) {
  const Status status = writeAtomically("/dev/full", "x");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadInput);
  EXPECT_NE(status.error().message.find("the disk is full"), std::string::npos)
      << status.error().message;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFileTest, DevicesAreWrittenStraight) {
  EXPECT_TRUE(writeAtomically("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(checkWritable("/dev/null"));
}

TEST_F(AtomicFileTest, StandardOutputIsAppendedTo) {
  // As `lambent … -o /dev/stdout >> log` would: what stood in the log stays.
  const fs::path log = folder_ / "log";
  ASSERT_TRUE(writeAtomically(log, "before "));
  const pid_t child = fork();
  if (child == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_APPEND);
    dup2(out, STDOUT_FILENO);
    _exit(writeAtomically("/dev/stdout", "after") ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(content(log), "before after");
  EXPECT_EQ(names(), Names{"log"});
}

TEST_F(AtomicFileTest, SymbolicLinkStaysALink) {
  fs::create_directory(folder_ / "real");
  fs::create_symlink(fs::path("real") / "target", folder_ / "link");
  ASSERT_TRUE(writeAtomically(folder_ / "link", "through a dangling link"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "real" / "target"), "through a dangling link");
  ASSERT_TRUE(writeAtomically(folder_ / "link", "again"));
  EXPECT_EQ(content(folder_ / "real" / "target"), "again");
  fs::create_symlink("loop", folder_ / "loop");
  EXPECT_FALSE(writeAtomically(folder_ / "loop", "x"));
}

TEST_F(AtomicFileTest, LongestNameWorks) {
  const std::string name(255, 'n');
  ASSERT_TRUE(writeAtomically(folder_ / name, "x"));
  EXPECT_EQ(names(), Names{name});
  EXPECT_FALSE(writeAtomically(folder_ / std::string(256, 'n'), "x"));
}

TEST_F(AtomicFileTest, RelativeNameWorks) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const Status status = writeAtomically("plain", "x");
  fs::current_path(before);
  EXPECT_TRUE(status);
  EXPECT_EQ(names(), Names{"plain"});
}

TEST_F(AtomicFileTest, FileSizeLimitKeepsTheOldFileAndTheProcess) {
  const fs::path path = folder_ / "a";
  ASSERT_TRUE(writeAtomically(path, "old"));
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, SIG_DFL);  // would kill
    const Status status = writeAtomically(path, std::string(100000, 'x'));
    _exit(!status && status.error().message.find("ulimit") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(AtomicFileTest, SignalHandlerDiscardsEverythingOpen) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGINT, [](int) {
      AtomicFile::discardAll();
      _exit(42);
    });
    Result<AtomicFile> a = AtomicFile::create(folder_ / "a");
    Result<AtomicFile> b = AtomicFile::create(folder_ / "b");
    Result<AtomicFile> c = AtomicFile::create(folder_ / "c");
    if (!a || !b || !c || !a->write("half") || !c->write("whole") || !c->commit()) _exit(1);
    if (::write(ready[1], "r", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char byte;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EQ(names().size(), 3u);
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(names(), Names{"c"});
  close(ready[0]);
  close(ready[1]);
}

TEST_F(AtomicFileTest, ManyThreadsAndMoreFilesThanSlots) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([this, t] {
      std::vector<AtomicFile> open;
      open.reserve(40);
      for (int i = 0; i < 40; ++i) {
        Result<AtomicFile> file = AtomicFile::create(folder_ / "same");
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->write(std::string(1000, static_cast<char>('a' + t))));
        open.push_back(std::move(*file));
      }
      for (AtomicFile& file : open) ASSERT_TRUE(file.commit());
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(names(), Names{"same"});
  EXPECT_EQ(content(folder_ / "same").size(), 1000u);
}

TEST_F(AtomicFileTest, ReadWhole) {
  std::string bytes(300000, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7);
  ASSERT_TRUE(writeAtomically(folder_ / "a", bytes));
  const Result<std::vector<std::byte>> read = readWhole(folder_ / "a");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), bytes.size());
  EXPECT_EQ(std::memcmp(read->data(), bytes.data(), bytes.size()), 0);

  ASSERT_TRUE(writeAtomically(folder_ / "empty", ""));
  const Result<std::vector<std::byte>> empty = readWhole(folder_ / "empty");
  ASSERT_TRUE(empty);
  EXPECT_TRUE(empty->empty());

  const Result<std::vector<std::byte>> proc = readWhole("/proc/self/status");
  ASSERT_TRUE(proc);
  EXPECT_GT(proc->size(), 100u);

  const Result<std::vector<std::byte>> missing = readWhole(folder_ / "missing");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(missing.error().message,
            (folder_ / "missing").string() +
                ": cannot read: No such file or directory; check the spelling of the path");
}

}  // namespace
}  // namespace lambent::file
