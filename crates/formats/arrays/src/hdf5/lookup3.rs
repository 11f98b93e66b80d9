//! Checksum of HDF5 structures: Jenkins' lookup3, as the format requires.

/// Checksum of `bytes`, with initial value 0.
pub(super) fn lookup3(bytes: &[u8]) -> u32 {
    let begin = 0xdead_beef_u32.wrapping_add(u32::try_from(bytes.len()).unwrap_or(u32::MAX));
    let (mut a, mut b, mut c) = (begin, begin, begin);
    let mut rest = bytes;
    while rest.len() > 12 {
        let (block, after) = rest.split_at(12);
        let [x, y, z] = words(block);
        (a, b, c) = (a.wrapping_add(x), b.wrapping_add(y), c.wrapping_add(z));
        mix(&mut a, &mut b, &mut c);
        rest = after;
    }
    if rest.is_empty() {
        return c;
    }
    let [x, y, z] = words(rest);
    (a, b, c) = (a.wrapping_add(x), b.wrapping_add(y), c.wrapping_add(z));
    finish(&mut a, &mut b, &mut c);
    c
}

/// Converts up to twelve bytes, padded with zeros, to three little-endian words.
fn words(bytes: &[u8]) -> [u32; 3] {
    let mut padded = [0; 12];
    padded[..bytes.len()].copy_from_slice(bytes);
    [0, 4, 8].map(|at| {
        let word = [padded[at], padded[at + 1], padded[at + 2], padded[at + 3]];
        u32::from_le_bytes(word)
    })
}

fn mix(a: &mut u32, b: &mut u32, c: &mut u32) {
    let step = |one: &mut u32, two: &mut u32, three: &mut u32, turn: u32| {
        *one = one.wrapping_sub(*three);
        *one ^= three.rotate_left(turn);
        *three = three.wrapping_add(*two);
    };
    step(a, b, c, 4);
    step(b, c, a, 6);
    step(c, a, b, 8);
    step(a, b, c, 16);
    step(b, c, a, 19);
    step(c, a, b, 4);
}

fn finish(a: &mut u32, b: &mut u32, c: &mut u32) {
    let step = |one: &mut u32, two: u32, turn: u32| {
        *one ^= two;
        *one = one.wrapping_sub(two.rotate_left(turn));
    };
    step(c, *b, 14);
    step(a, *c, 11);
    step(b, *a, 25);
    step(c, *b, 16);
    step(a, *c, 4);
    step(b, *a, 14);
    step(c, *b, 24);
}

#[cfg(test)]
mod tests {
    use super::lookup3;

    #[test]
    fn sums_are_those_that_its_author_states() {
        assert_eq!(lookup3(b""), 0xdead_beef);
        assert_eq!(lookup3(b"Four score and seven years ago"), 0x1777_0551);
    }
}
