/// FNV-1a hash of the empty input.
///
/// ```
/// use taceva_core::random::{FNV_OFFSET, fnv_1a};
/// assert_eq!(fnv_1a(b""), FNV_OFFSET);
/// ```
pub const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;

/// 64-bit FNV-1a hash of `bytes`, with the published constants of Fowler, Noll and Vo. Stable across versions, but not for cryptography.
///
/// ```
/// use taceva_core::random::fnv_1a;
/// assert_eq!(fnv_1a(b"a"), 0xaf63_dc4c_8601_ec8c);
/// ```
#[must_use]
pub fn fnv_1a(bytes: &[u8]) -> u64 {
    fnv_1a_after(FNV_OFFSET, bytes)
}

/// Continues the FNV-1a hash `hash` of earlier bytes with `bytes`.
///
/// ```
/// use taceva_core::random::{fnv_1a, fnv_1a_after};
/// assert_eq!(fnv_1a_after(fnv_1a(b"foo"), b"bar"), fnv_1a(b"foobar"));
/// ```
#[must_use]
pub fn fnv_1a_after(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_that_of_the_reference() {
        // Test vectors of the FNV reference.
        assert_eq!(fnv_1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv_1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv_1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
