// SPDX-License-Identifier: Apache-2.0
#define SPHERETREE_MASK_TEMPLATE template

#include "MaskGrids.h"
