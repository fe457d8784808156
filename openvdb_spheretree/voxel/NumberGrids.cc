// SPDX-License-Identifier: Apache-2.0
#define SPHERETREE_NUMBER_TEMPLATE template

#include "GridTemplates.h"
