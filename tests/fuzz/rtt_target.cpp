// Radiance transfer textures, .rtt.
#include "lambent/asset/rtt_file.h"
#include "lambent/asset/summary.h"
#include "lambent/shade/rtt_pyramid.h"
#include "lambent/transfer/encode.h"
#include "tests/fuzz/folder.h"

namespace lambent::fuzz {

void rtt(Bytes bytes) {
  const Folder& folder = Folder::ofProcess();
  const auto path = folder.write("in.rtt", bytes);
  (void)asset::isRtt(path);
  const Result<transfer::EncodedRtt> rtt = asset::readRtt(path);
  if (!rtt) return require(rtt.error().kind == ErrorKind::BadInput, "a bad file is BadInput");
  (void)asset::summarize(*rtt);
  const transfer::SimulatedRtt floats = transfer::decode(*rtt);
  require(floats.values.size() == rtt->values.size(), "every number is decoded");
  if (floats.values.size() <= 16 * kMostElements) (void)shade::makePyramid(floats);

  const Status written = asset::writeRtt(*rtt, folder / "again.rtt");
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  require(bool(written), "a texture that was read can be written");
  const Result<transfer::EncodedRtt> again = asset::readRtt(folder / "again.rtt");
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  require(bool(again), "a texture that was written can be read");
  const transfer::Numbers &before = rtt->values, &after = again->values;
  require(before.half == after.half && before.byte == after.byte && before.scales == after.scales &&
              before.single == after.single,
          "numbers come back as they were");
}

}  // namespace lambent::fuzz
