#include <math.h>
#include <stdio.h>
#include "loop.h"

int main(void)
{
    static loop_t self;
    float y[1] = {0}, u[1] = {0};
    unsigned status = 0;

    (void)y;
    (void)u;
    (void)status;
    loop_init(&self);

    for (int k = 0; k < 20; k++)
        status |= loop_step(&self, y, u);
    printf("%u %u %u ", status, self.sample, self.gain_row);
    u[0] = (float)NAN;
    status = loop_predict(&self, u);
    printf("%u %u %u", status, self.sample, self.gain_row);
    return 0;
}
