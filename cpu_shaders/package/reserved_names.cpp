#include "cpu_shaders/package/reserved_names.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "cpu_shaders/translate/cpp_keywords.h"

namespace twinshade {
namespace {

constexpr const char* kOurs = "Uniforms BasicInputs BasicOutputs Real std twinshade";

// By header, as C++20 lists them; glibc's beside them. <complex.h> has no I in C++.
constexpr const char* kMacros =
    // assert.h, stddef.h and what compilers define by themselves
    "NDEBUG NULL linux unix i386 "
    // errno.h
    "errno E2BIG EACCES EADDRINUSE EADDRNOTAVAIL EAFNOSUPPORT EAGAIN EALREADY EBADF EBADMSG EBUSY ECANCELED ECHILD "
    "ECONNABORTED ECONNREFUSED ECONNRESET EDEADLK EDESTADDRREQ EDOM EDQUOT EEXIST EFAULT EFBIG EHOSTUNREACH EIDRM "
    "EILSEQ EINPROGRESS EINTR EINVAL EIO EISCONN EISDIR ELOOP EMFILE EMLINK EMSGSIZE ENAMETOOLONG ENETDOWN ENETRESET "
    "ENETUNREACH ENFILE ENOBUFS ENODATA ENODEV ENOENT ENOEXEC ENOLCK ENOLINK ENOMEM ENOMSG ENOPROTOOPT ENOSPC ENOSR "
    "ENOSTR ENOSYS ENOTCONN ENOTDIR ENOTEMPTY ENOTRECOVERABLE ENOTSOCK ENOTSUP ENOTTY ENXIO EOPNOTSUPP EOVERFLOW "
    "EOWNERDEAD EPERM EPIPE EPROTO EPROTONOSUPPORT EPROTOTYPE ERANGE EROFS ESPIPE ESRCH ESTALE ETIME ETIMEDOUT "
    "ETXTBSY EWOULDBLOCK EXDEV "
    // fenv.h
    "FE_ALL_EXCEPT FE_DFL_ENV FE_DIVBYZERO FE_DOWNWARD FE_INEXACT FE_INVALID FE_OVERFLOW FE_TONEAREST FE_TOWARDZERO "
    "FE_UNDERFLOW FE_UPWARD "
    // float.h
    "DECIMAL_DIG FLT_EVAL_METHOD FLT_RADIX FLT_ROUNDS DBL_DECIMAL_DIG DBL_DIG DBL_EPSILON DBL_HAS_SUBNORM "
    "DBL_MANT_DIG DBL_MAX DBL_MAX_10_EXP DBL_MAX_EXP DBL_MIN DBL_MIN_10_EXP DBL_MIN_EXP DBL_TRUE_MIN FLT_DECIMAL_DIG "
    "FLT_DIG FLT_EPSILON FLT_HAS_SUBNORM FLT_MANT_DIG FLT_MAX FLT_MAX_10_EXP FLT_MAX_EXP FLT_MIN FLT_MIN_10_EXP "
    "FLT_MIN_EXP FLT_TRUE_MIN LDBL_DECIMAL_DIG LDBL_DIG LDBL_EPSILON LDBL_HAS_SUBNORM LDBL_MANT_DIG LDBL_MAX "
    "LDBL_MAX_10_EXP LDBL_MAX_EXP LDBL_MIN LDBL_MIN_10_EXP LDBL_MIN_EXP LDBL_TRUE_MIN "
    // limits.h
    "CHAR_BIT CHAR_MAX CHAR_MIN INT_MAX INT_MIN LLONG_MAX LLONG_MIN LONG_MAX LONG_MIN MB_LEN_MAX SCHAR_MAX SCHAR_MIN "
    "SHRT_MAX SHRT_MIN UCHAR_MAX UINT_MAX ULLONG_MAX ULONG_MAX USHRT_MAX "
    "NAME_MAX PATH_MAX PIPE_BUF SSIZE_MAX "
    // locale.h
    "LC_ALL LC_COLLATE LC_CTYPE LC_MESSAGES LC_MONETARY LC_NUMERIC LC_TIME "
    // math.h
    "FP_FAST_FMA FP_FAST_FMAF FP_FAST_FMAL FP_ILOGB0 FP_ILOGBNAN FP_INFINITE FP_NAN FP_NORMAL FP_SUBNORMAL FP_ZERO "
    "HUGE_VAL HUGE_VALF HUGE_VALL INFINITY MATH_ERREXCEPT MATH_ERRNO NAN math_errhandling "
    "MAXFLOAT M_1_PI M_2_PI M_2_SQRTPI M_E M_LN10 M_LN2 M_LOG10E M_LOG2E M_PI M_PI_2 M_PI_4 M_SQRT1_2 M_SQRT2 "
    // signal.h
    "SIGABRT SIGFPE SIGILL SIGINT SIGSEGV SIGTERM SIG_DFL SIG_ERR SIG_IGN "
    "SIGALRM SIGBUS SIGCHLD SIGCONT SIGHUP SIGIO SIGKILL SIGPIPE SIGPROF SIGQUIT SIGSTOP SIGTRAP SIGTSTP SIGTTIN "
    "SIGTTOU SIGURG SIGUSR1 SIGUSR2 SIGWINCH SIG_BLOCK SIG_SETMASK SIG_UNBLOCK "
    // stdint.h
    "INT16_MAX INT16_MIN INT32_MAX INT32_MIN INT64_MAX INT64_MIN INT8_MAX INT8_MIN INTMAX_MAX INTMAX_MIN INTPTR_MAX "
    "INTPTR_MIN INT_FAST16_MAX INT_FAST16_MIN INT_FAST32_MAX INT_FAST32_MIN INT_FAST64_MAX INT_FAST64_MIN "
    "INT_FAST8_MAX INT_FAST8_MIN INT_LEAST16_MAX INT_LEAST16_MIN INT_LEAST32_MAX INT_LEAST32_MIN INT_LEAST64_MAX "
    "INT_LEAST64_MIN INT_LEAST8_MAX INT_LEAST8_MIN PTRDIFF_MAX PTRDIFF_MIN SIG_ATOMIC_MAX SIG_ATOMIC_MIN SIZE_MAX "
    "UINT16_MAX UINT32_MAX UINT64_MAX UINT8_MAX UINTMAX_MAX UINTPTR_MAX UINT_FAST16_MAX UINT_FAST32_MAX "
    "UINT_FAST64_MAX UINT_FAST8_MAX UINT_LEAST16_MAX UINT_LEAST32_MAX UINT_LEAST64_MAX UINT_LEAST8_MAX WCHAR_MAX "
    "WCHAR_MIN WINT_MAX WINT_MIN "
    // stdio.h
    "BUFSIZ EOF FILENAME_MAX FOPEN_MAX L_tmpnam SEEK_CUR SEEK_END SEEK_SET TMP_MAX stderr stdin stdout P_tmpdir "
    // stdlib.h
    "EXIT_FAILURE EXIT_SUCCESS MB_CUR_MAX RAND_MAX "
    // time.h
    "CLOCKS_PER_SEC TIME_UTC CLOCK_MONOTONIC CLOCK_REALTIME "
    // wchar.h
    "WEOF "
    // unistd.h and endian.h, which others include
    "STDERR_FILENO STDIN_FILENO STDOUT_FILENO F_OK R_OK W_OK X_OK BIG_ENDIAN BYTE_ORDER LITTLE_ENDIAN "
    // atomic
    "ATOMIC_BOOL_LOCK_FREE ATOMIC_CHAR16_T_LOCK_FREE ATOMIC_CHAR32_T_LOCK_FREE ATOMIC_CHAR8_T_LOCK_FREE "
    "ATOMIC_CHAR_LOCK_FREE ATOMIC_FLAG_INIT ATOMIC_INT_LOCK_FREE ATOMIC_LLONG_LOCK_FREE ATOMIC_LONG_LOCK_FREE "
    "ATOMIC_POINTER_LOCK_FREE ATOMIC_SHORT_LOCK_FREE ATOMIC_WCHAR_T_LOCK_FREE";

std::set<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::set<std::string> words;
  for (std::string word; in >> word;) words.insert(word);
  return words;
}

bool is_macro(const std::string& name) {
  static const std::set<std::string> macros = words_of(kMacros);
  return macros.count(name) != 0;
}

}  // namespace

bool is_reserved_name(const std::string& name) {
  static const std::set<std::string> ours = words_of(kOurs);
  return spirv::is_cpp_keyword(name) || is_macro(name) || ours.count(name) != 0;
}

std::string header_name_refusal(const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  const auto is_other = [](char c) { return (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty() || !is_letter(name[0]) ||
      !std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || is_other(c); }))
    return "it must begin with a letter and have letters, digits and underscores only";
  if (spirv::is_cpp_keyword(name)) return "it is a word of C++";
  if (is_macro(name)) return "it is a macro of C";
  if (name == "limits") return "limits.h would stand in for the system's";  // g++'s includes the next one by quotes
  return "";
}

}  // namespace twinshade
