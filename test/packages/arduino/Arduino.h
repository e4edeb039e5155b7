/* SPDX-License-Identifier: MIT */
/* Stands in for the Arduino core on the PC, as far as the sketch DcMotor goes. */
#ifndef ARDUINO_H
#define ARDUINO_H

#include <cstdio>

#define F(text) text

static struct {
    void begin(long) {}
    void print(const char *text)
    {
        std::printf("%s", text);
    }
    void print(char character)
    {
        std::printf("%c", character);
    }
    void print(long number)
    {
        std::printf("%ld", number);
    }
    void print(int number)
    {
        std::printf("%d", number);
    }
    void print(unsigned number)
    {
        std::printf("%u", number);
    }
    void print(unsigned long number)
    {
        std::printf("%lu", number);
    }
    template <typename Value>
    void println(Value value)
    {
        print(value);
        std::printf("\n");
    }
} Serial;

static unsigned long micros()
{
    return 0;
}

void setup();
void loop();

#endif
