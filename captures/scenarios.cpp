#include "captures/scenarios.h"
