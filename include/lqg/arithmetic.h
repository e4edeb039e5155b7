/* SPDX-License-Identifier: MIT */
/* TinyLQG: the scalar of the target, and what a compiler may do with it.
 *
 * Every product, sum and quotient of TinyLQG is rounded once, in the order in which it is written. That is
 * why the PC, the emulator and every microcontroller find the same bits, and why a NaN is noticed. This
 * header keeps it so.
 *
 * Options, to be defined for the whole program (-D…), library and firmware alike:
 *
 *   LQG_REAL_DOUBLE   lqg_real is double; otherwise it is float.
 *   LQG_FUSED         the library's multiply-adds are fmaf() or fma(), rounded once: faster and closer where
 *                     the hardware has the instruction, very slow where it does not. Otherwise both
 *                     operations round.
 *   LQG_SLOW_FUSED    no message where fused multiply-adds are slow.
 */
#ifndef LQG_ARITHMETIC_H
#define LQG_ARITHMETIC_H

#if defined __FAST_MATH__ || (defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__ == 1) || defined _M_FP_FAST
#error "TinyLQG cannot be compiled with -ffast-math: NaNs are lost. Leave out -ffast-math, -Ofast, -ffinite-math-only."
#endif

#if defined __ASSOCIATIVE_MATH__ || defined __RECIPROCAL_MATH__
#error "TinyLQG: operations change order. Leave out -funsafe-math-optimizations, -fassociative-math, -freciprocal-math."
#endif

/* 16 is what processors with half precision say: it leaves float and double alone. */
#if defined __FLT_EVAL_METHOD__ && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "TinyLQG needs operations rounded to float: leave out -ffp-eval-method; on x86 use -msse2 -mfpmath=sse, not x87."
#endif

#if defined LQG_REAL_DOUBLE && defined __SIZEOF_DOUBLE__ && __SIZEOF_DOUBLE__ < 8
#error "TinyLQG: LQG_REAL_DOUBLE asks for a double of 64 bits, and this compiler's has less. Leave it out."
#endif

#ifdef LQG_REAL_DOUBLE
typedef double lqg_real;
#else
typedef float lqg_real;
#endif

/* What GCC and clang do to arithmetic unless told otherwise (contraction: a*b + c becomes one fused multiply-add behind
 * our back), and what the options around allow them (to forget NaNs and signs of zero, to reorder sums, to divide by
 * multiplying), is switched off from the inside; the code around keeps its own options.
 *
 *     LQG_STRICT_BEGIN                     before the first function
 *     lqg_real f(lqg_real a, lqg_real b)
 *     {
 *         LQG_STRICT_BODY                  first in each function with arithmetic (clang)
 *         return a * a + b;
 *     }
 *     LQG_STRICT_END                       after the last function
 *
 * Of clang, three things stay open, and lqg/check.h finds them. An explicit -ffp-contract=fast cannot be overruled: use
 * fast-honor-pragmas in its place. ?: and the unary minus keep the options around. And where a target has no
 * float_control, as 32-bit Arm, all operations keep -fno-honor-nans and its like.
 *
 * GCC's vectorizer is switched off with it: GCC 12 makes vfmaddsub and vfmsubadd of separate products and sums in
 * spite of fp-contract=off. Such functions must not be always_inline: they would take over the options of their caller.
 */
#if defined __clang__
#define LQG_STRICT_BEGIN \
    _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wignored-pragmas\"") \
    _Pragma("float_control(push)") _Pragma("float_control(precise, on)") _Pragma("clang diagnostic pop")
#define LQG_STRICT_BODY _Pragma("clang fp contract(off)")
#define LQG_STRICT_END \
    _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wignored-pragmas\"") \
    _Pragma("float_control(pop)") _Pragma("clang diagnostic pop")
#elif defined __GNUC__
#define LQG_STRICT_BEGIN \
    _Pragma("GCC push_options") \
    _Pragma("GCC optimize (\"fp-contract=off\", \"no-tree-vectorize\")") \
    _Pragma("GCC optimize (\"no-unsafe-math-optimizations\", \"no-associative-math\", \"no-reciprocal-math\")") \
    _Pragma("GCC optimize (\"signed-zeros\", \"no-finite-math-only\", \"no-single-precision-constant\")")
#define LQG_STRICT_BODY
#define LQG_STRICT_END _Pragma("GCC pop_options")
#else
#define LQG_STRICT_BEGIN _Pragma("STDC FP_CONTRACT OFF")
#define LQG_STRICT_BODY
#define LQG_STRICT_END _Pragma("STDC FP_CONTRACT DEFAULT")
#endif

/* Whether a fused multiply-add of floats, of doubles, is an instruction: 1 or 0. Otherwise it is a call of the C
 * library, with the same result; on x86-64 a controller then takes about four times as long. The compiler has to be
 * told of the instruction: -mfma or -march=native (x86-64), /arch:AVX2 (MSVC), -mfpu (Arm), -march (RISC-V). */
#if defined __FP_FAST_FMAF || defined __FMA__ || defined __AVX2__ || defined __aarch64__ || defined _M_ARM64 || \
    defined __ARM_FEATURE_FMA || defined __riscv_flen
#define LQG_HAS_FMAF 1
#else
#define LQG_HAS_FMAF 0
#endif
#if defined __FP_FAST_FMA || defined __FMA__ || defined __AVX2__ || defined __aarch64__ || defined _M_ARM64
#define LQG_HAS_FMA 1
#elif defined __ARM_FEATURE_FMA && defined __ARM_FP
#define LQG_HAS_FMA ((__ARM_FP & 8) != 0)
#elif defined __riscv_flen
#define LQG_HAS_FMA (__riscv_flen >= 64)
#else
#define LQG_HAS_FMA 0
#endif

/* The name by which the linker knows a library function of this scalar and arithmetic. Firmware compiled with
 * other options than its library does not link; it never computes with misread numbers. */
#if defined LQG_REAL_DOUBLE && defined LQG_FUSED
#define LQG_VARIANT(name) name##_f64_fused
#elif defined LQG_REAL_DOUBLE
#define LQG_VARIANT(name) name##_f64
#elif defined LQG_FUSED
#define LQG_VARIANT(name) name##_f32_fused
#else
#define LQG_VARIANT(name) name##_f32
#endif

#endif
