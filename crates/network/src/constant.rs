//! Converts run-time numbers to compile-time constants.

/// Evaluates `$call` with `$number` as the constant `$constant`. The call is compiled once for each of `$known`, so that accumulators remain in registers.
macro_rules! with_constant {
    ($constant:ident = $number:expr, one of [$($known:literal),+] => $call:expr) => {
        match $number {
            $($known => {
                const $constant: usize = $known;
                $call
            })+
            _ => unreachable!("a number outside the compiled list"),
        }
    };
}

pub(crate) use with_constant;
