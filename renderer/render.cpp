#include "renderer/render.h"
