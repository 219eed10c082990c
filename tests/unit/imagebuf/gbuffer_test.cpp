#include "imagebuf/gbuffer.h"
