// The figures of sloan2003biscale (bi-scale radiance transfer), the truth beside them, and what
// else is measured of it.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

void biscaleTruth(const Studio& studio);
void biscaleResolution(const Studio& studio);
void biscaleFigure1(const Studio& studio);
void biscaleFigure3(const Studio& studio);
void biscaleFigure4(const Studio& studio);
void biscaleFigure5(const Studio& studio);
void biscaleFigure6(const Studio& studio);
void biscaleVase(const Studio& studio);
void biscaleFilter(const Studio& studio);
void biscaleEncodings(const Studio& studio);
void biscaleRttMethods(const Studio& studio);

}  // namespace lambent::figures
