// Figures 3, 9, 10, 11 and 12 of sloan2002precomputed, and its Table 1.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

void figure3(const Studio& studio);
void figure9(const Studio& studio);
void figure10(const Studio& studio);
void figure11(const Studio& studio);
void figure12(const Studio& studio);
void table1(const Studio& studio);

}  // namespace lambent::figures
