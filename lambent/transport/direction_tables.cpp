#include "lambent/transport/direction_tables.h"

#include "lambent/sh/basis.h"

namespace lambent::transport {

DirectionTable::DirectionTable(const trace::DirectionSet& directions, int bands)
    : bands_(bands), stride_(paddedRow(sh::coefficientCount(bands))) {
  values_.assign(directions.size() * stride_, 0.0f);
  std::vector<double> y(sh::coefficientCount(bands));
  for (std::size_t d = 0; d < directions.size(); ++d) {
    sh::evaluate(bands, directions[d].cast<double>().normalized(), std::span<double>(y));
    for (std::size_t i = 0; i < y.size(); ++i) values_[d * stride_ + i] = static_cast<float>(y[i]);
  }
}

}  // namespace lambent::transport
