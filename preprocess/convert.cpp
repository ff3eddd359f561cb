#include "preprocess/convert.h"
