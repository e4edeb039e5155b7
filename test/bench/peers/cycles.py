# SPDX-License-Identifier: MIT
"""cycles.py PROGRAM.elf: estimated cycles of one peer_sample on a Cortex-M4F, the 150th, which is executed instruction
by instruction. An estimate, not a measurement: memory without wait states, and these prices, from the core's Technical
Reference Manual:

    vfma, vfms, vmla, vmls and their negatives   3
    vdiv, vsqrt                                 14
    one load                                     2, or 1 directly behind another one
    load or store of N words                     1 + N
    sdiv, udiv                                  12, the most that they take
    taken branch, pop or load of pc              2 more
    everything else                              1

Prints `cycles=` and `traced=`, the instructions."""

import re
import sys

import capstone
import unicorn
from unicorn import arm_const

FLASH, RAM, SYSTEM, SIZE = 0x00000000, 0x20000000, 0xE0000000, 0x400000
SAMPLE = 150

ACCUMULATES = re.compile(r"vfn?m[as]|vn?ml[as]")
DIVIDES = re.compile(r"vdiv|vsqrt")
LOADS = re.compile(r"v?ldr")
MANY = re.compile(r"v?ldm|v?stm|v?push|v?pop|ldrd|strd")
INTEGER_DIVIDES = re.compile(r"[su]div")


class Core:
    """A core of the A profile that executes the same instructions. Nothing listens to the system's registers: they are
    memory."""

    def __init__(self, path):
        self.machine = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB)
        for start in (FLASH, RAM, SYSTEM):
            self.machine.mem_map(start, SIZE)
        with open(path, "rb") as file:
            self.program = file.read()
        self.load()
        self.machine.reg_write(arm_const.UC_ARM_REG_C1_C0_2, 0xF00000)
        self.machine.reg_write(arm_const.UC_ARM_REG_FPEXC, 0x40000000)

    def word(self, offset, size=4):
        return int.from_bytes(self.program[offset : offset + size], "little")

    def load(self):
        """The segments of the ELF file, at their addresses in flash."""
        headers, size, count = self.word(28), self.word(42, 2), self.word(44, 2)
        for header in range(headers, headers + size * count, size):
            offset, address, length = self.word(header + 4), self.word(header + 12), self.word(header + 16)
            if self.word(header) == 1 and length:
                self.machine.mem_write(address, self.program[offset : offset + length])

    def symbol(self, name):
        """The address of a function, by the first table of symbols."""
        headers, size, count = self.word(32), self.word(46, 2), self.word(48, 2)
        for header in range(headers, headers + size * count, size):
            if self.word(header + 4) != 2:
                continue
            names = self.word(headers + size * self.word(header + 24) + 16)
            start, length = self.word(header + 16), self.word(header + 20)
            for entry in range(start, start + length, 16):
                text = names + self.word(entry)
                if self.program[text : text + len(name) + 1] == name.encode() + b"\0":
                    return self.word(entry + 4) & ~1
        sys.exit(f"{sys.argv[1]}: expected a symbol {name}, found none")

    def run_to_sample(self):
        """From reset on, up to the call of the sample; returns where it comes back to."""
        calls = 0

        def called(*_):
            nonlocal calls
            calls += 1
            if calls == SAMPLE:
                self.machine.emu_stop()

        start = self.symbol("peer_sample")
        hook = self.machine.hook_add(unicorn.UC_HOOK_CODE, called, begin=start, end=start)
        self.machine.reg_write(arm_const.UC_ARM_REG_SP, self.word(self.offset_of_vectors()))
        self.machine.emu_start(self.symbol("reset") | 1, 0)
        self.machine.hook_del(hook)
        return self.machine.reg_read(arm_const.UC_ARM_REG_LR) & ~1

    def offset_of_vectors(self):
        header = self.word(28)
        return self.word(header + 4) + FLASH - self.word(header + 12)

    def trace(self, end):
        """The addresses and lengths of the instructions, from here to there."""
        addresses = []

        def executed(_, address, size, __):
            if address == end:
                self.machine.emu_stop()
            else:
                addresses.append((address, size))

        self.machine.ctl_flush_tb()  # what has been translated before has no hook
        self.machine.hook_add(unicorn.UC_HOOK_CODE, executed)
        self.machine.emu_start(self.machine.reg_read(arm_const.UC_ARM_REG_PC) | 1, end)
        return addresses


def price(instruction):
    name, operands = instruction.mnemonic, instruction.op_str
    if ACCUMULATES.match(name):
        return 3
    if DIVIDES.match(name):
        return 14
    if INTEGER_DIVIDES.match(name):
        return 12
    if MANY.match(name):
        return 1 + (2 if name.startswith(("ldrd", "strd")) else words_of(operands))
    return 2 if LOADS.match(name) else 1


def words_of(operands):
    """Of a list of registers: those of double precision are two."""
    registers = operands[operands.index("{") + 1 : operands.index("}")].split(", ")
    return sum(2 if register.startswith("d") else 1 for register in registers)


def cycles_of(core, addresses):
    disassembler = capstone.Cs(capstone.CS_ARCH_ARM, capstone.CS_MODE_THUMB | capstone.CS_MODE_MCLASS)
    known, sum_of_prices, behind_load = {}, 0, False
    for (address, size), (following, _) in zip(addresses, addresses[1:] + [(None, 0)]):
        if address not in known:
            instruction = next(disassembler.disasm(bytes(core.machine.mem_read(address, size)), address))
            is_load = LOADS.match(instruction.mnemonic) and not MANY.match(instruction.mnemonic)
            known[address] = price(instruction), bool(is_load)
        cost, is_load = known[address]
        sum_of_prices += cost - (is_load and behind_load) + (2 if following != address + size else 0)
        behind_load = is_load
    return sum_of_prices


def main():
    core = Core(sys.argv[1])
    addresses = core.trace(core.run_to_sample())
    print(f"cycles={cycles_of(core, addresses)}\ntraced={len(addresses)}")


main()
