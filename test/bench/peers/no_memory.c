/* SPDX-License-Identifier: MIT */
/* Eigen names malloc for matrices that are larger than these: nobody gets any memory. */
void *_sbrk(int bytes);
void *_sbrk(int bytes)
{
    (void)bytes;
    return (void *)-1;
}
