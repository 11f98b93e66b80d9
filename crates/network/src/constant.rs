//! Run-time numbers as compile-time constants.

/// Evaluates `$call` with `$number` as the constant `$constant`. Compiled once for each of `$known`, so that accumulators are registers.
macro_rules! with_constant {
    ($constant:ident = $number:expr, one of [$($known:literal),+] => $call:expr) => {
        match $number {
            $($known => {
                const $constant: usize = $known;
                $call
            })+
            _ => unreachable!("beyond what was compiled"),
        }
    };
}

pub(crate) use with_constant;
