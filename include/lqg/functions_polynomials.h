/* SPDX-License-Identifier: MIT */
/* TinyLQG: the polynomials of elementary functions, made by test/src/functions/coefficients.py. Each has the least
 * largest relative error of those whose coefficients are numbers of its type; the errors are those of exact
 * arithmetic. */
#ifndef LQG_FUNCTIONS_POLYNOMIALS_H
#define LQG_FUNCTIONS_POLYNOMIALS_H

#include "lqg/arithmetic.h"
#include "lqg/functions_bits.h"

LQG_STRICT_BEGIN

/* sin x = x + x z P(z), z = x²; off by 2^−27.9, relative. */
static inline float lqg_sin_polynomialf(float z)
{
    LQG_STRICT_BODY
    float p = -0.000195182845f;
    p = p * z + 0.00833218917f;
    p = p * z - 0.166666552f;
    return p;
}

/* cos x = 1 − z/2 + z² P(z), z = x²; off by 2^−32.9, relative. */
static inline float lqg_cos_polynomialf(float z)
{
    LQG_STRICT_BODY
    float p = 2.44325638e-05f;
    p = p * z - 0.00138873106f;
    p = p * z + 0.0416666456f;
    return p;
}

/* tan x = x + x z P(z), z = x²; off by 2^−29.5, relative. */
static inline float lqg_tan_polynomialf(float z)
{
    LQG_STRICT_BODY
    float p = 0.00437041372f;
    p = p * z + 0.000102860875f;
    p = p * z + 0.0108238589f;
    p = p * z + 0.0212875344f;
    p = p * z + 0.0540586822f;
    p = p * z + 0.133326769f;
    p = p * z + 0.333333492f;
    return p;
}

/* asin x = x + x z P(z), z = x²; off by 2^−28.9, relative. */
static inline float lqg_asin_polynomialf(float z)
{
    LQG_STRICT_BODY
    float p = 0.0474931747f;
    p = p * z + 0.00673548598f;
    p = p * z + 0.0340126604f;
    p = p * z + 0.0442319885f;
    p = p * z + 0.0750209838f;
    p = p * z + 0.166666314f;
    return p;
}

/* atan x = x + x z P(z), z = x²; off by 2^−28.5, relative. */
static inline float lqg_atan_polynomialf(float z)
{
    LQG_STRICT_BODY
    float p = -0.001791502f;
    p = p * z + 0.0109045366f;
    p = p * z - 0.0311577655f;
    p = p * z + 0.0579358004f;
    p = p * z - 0.0840205625f;
    p = p * z + 0.109516546f;
    p = p * z - 0.142641261f;
    p = p * z + 0.199985355f;
    p = p * z - 0.333332986f;
    return p;
}

/* exp x = 1 + x + x² P(x); off by 2^−28.1, relative. */
static inline float lqg_exp_polynomialf(float x)
{
    LQG_STRICT_BODY
    float p = 0.00137825042f;
    p = p * x + 0.00836867467f;
    p = p * x + 0.0416689627f;
    p = p * x + 0.166665211f;
    p = p * x + 0.499999911f;
    return p;
}

/* log(1 + x) = x − x²/2 + x³ P(x); off by 2^−27.1, relative. */
static inline float lqg_log_polynomialf(float x)
{
    LQG_STRICT_BODY
    float p = -0.0779107586f;
    p = p * x + 0.128500775f;
    p = p * x - 0.131372318f;
    p = p * x + 0.141851157f;
    p = p * x - 0.166242704f;
    p = p * x + 0.200022206f;
    p = p * x - 0.250008136f;
    p = p * x + 0.333333135f;
    return p;
}

/* tanh x = x + x z P(z), z = x²; off by 2^−29.6, relative. */
static inline float lqg_tanh_polynomialf(float z)
{
    LQG_STRICT_BODY
    float p = -0.00626174267f;
    p = p * z + 0.021061942f;
    p = p * z - 0.0538496375f;
    p = p * z + 0.133325562f;
    p = p * z - 0.333333164f;
    return p;
}

#if LQG_HAS_DOUBLE
/* sin x = x + x z P(z), z = x²; off by 2^−57.8, relative. */
static inline double lqg_sin_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = 1.5895943637451341e-10;
    p = p * z - 2.5050742320642017e-08;
    p = p * z + 2.7557313582264422e-06;
    p = p * z - 0.0001984126982945851;
    p = p * z + 0.0083333333333219187;
    p = p * z - 0.1666666666666663;
    return p;
}

/* cos x = 1 − z/2 + z² P(z), z = x²; off by 2^−63.9, relative. */
static inline double lqg_cos_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = -1.1358748095206087e-11;
    p = p * z + 2.0875705404102261e-09;
    p = p * z - 2.7557314217299276e-07;
    p = p * z + 2.4801587289003468e-05;
    p = p * z - 0.0013888888888873344;
    p = p * z + 0.041666666666666595;
    return p;
}

/* tan x = x + x z P(z), z = x²; off by 2^−56.2, relative. */
static inline double lqg_tan_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = 2.0864883546228418e-05;
    p = p * z - 4.4883565392384173e-05;
    p = p * z + 8.9465833224437036e-05;
    p = p * z - 2.6401470693132528e-05;
    p = p * z + 0.00013653686817320334;
    p = p * z + 0.00022237407935984775;
    p = p * z + 0.00059506676810115624;
    p = p * z + 0.0014547574607488428;
    p = p * z + 0.0035922891688729445;
    p = p * z + 0.0088632191530482168;
    p = p * z + 0.021869489609934466;
    p = p * z + 0.053968253926619733;
    p = p * z + 0.13333333333414757;
    p = p * z + 0.33333333333332776;
    return p;
}

/* asin x = x + x z P(z), z = x²; off by 2^−54.2, relative. */
static inline double lqg_asin_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = 0.055631208833590559;
    p = p * z - 0.062129481781377095;
    p = p * z + 0.054312941231603344;
    p = p * z - 0.011371755097408212;
    p = p * z + 0.015283434815884973;
    p = p * z + 0.010490612440770078;
    p = p * z + 0.014106522192383593;
    p = p * z + 0.017339727942259357;
    p = p * z + 0.022372964864506972;
    p = p * z + 0.030381912567523959;
    p = p * z + 0.044642857884606375;
    p = p * z + 0.074999999991323577;
    p = p * z + 0.1666666666667021;
    return p;
}

/* atan x = x + x z P(z), z = x²; off by 2^−57.5, relative. */
static inline double lqg_atan_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = 0.024409001188008296;
    p = p * z - 0.04590490380783472;
    p = p * z + 0.057647246010256781;
    p = p * z - 0.066535636029771819;
    p = p * z + 0.076913599260992171;
    p = p * z - 0.090908649316034387;
    p = p * z + 0.11111109832606898;
    p = p * z - 0.14285714264382093;
    p = p * z + 0.19999999999823401;
    p = p * z - 0.33333333333332826;
    return p;
}

/* exp x = 1 + x + x² P(x); off by 2^−57.8, relative. */
static inline double lqg_exp_polynomial(double x)
{
    LQG_STRICT_BODY
    double p = 2.5004611754833166e-08;
    p = p * x + 2.7630473179397561e-07;
    p = p * x + 2.7557572053764215e-06;
    p = p * x + 2.4801492415614409e-05;
    p = p * x + 0.00019841269522593547;
    p = p * x + 0.0013888888944362959;
    p = p * x + 0.0083333333334870384;
    p = p * x + 0.041666666666526936;
    p = p * x + 0.16666666666666424;
    p = p * x + 0.50000000000000111;
    return p;
}

/* log((1 + x)/(1 − x)) = 2x + x z P(z), z = x²; off by 2^−59.4, relative. */
static inline double lqg_log_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = 0.14798017536961214;
    p = p * z + 0.15313855444726068;
    p = p * z + 0.1818357149579129;
    p = p * z + 0.22222198443972385;
    p = p * z + 0.28571428743564609;
    p = p * z + 0.39999999999409713;
    p = p * z + 0.66666666666667351;
    return p;
}

/* tanh x = x + x z P(z), z = x²; off by 2^−55.4, relative. */
static inline double lqg_tanh_polynomial(double z)
{
    LQG_STRICT_BODY
    double p = 5.1010280057259665e-05;
    p = p * z - 0.00021028641902203225;
    p = p * z + 0.00057912736662746854;
    p = p * z - 0.0014532135485340425;
    p = p * z + 0.0035917190572886978;
    p = p * z - 0.0088631944257358576;
    p = p * z + 0.021869485969040346;
    p = p * z - 0.053968253875841039;
    p = p * z + 0.13333333333168229;
    p = p * z - 0.3333333333333231;
    return p;
}
#endif

LQG_STRICT_END

#endif
