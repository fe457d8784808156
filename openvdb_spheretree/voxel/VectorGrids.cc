// SPDX-License-Identifier: Apache-2.0
#define SPHERETREE_VECTOR_TEMPLATE template

#include "GridTemplates.h"
