//! Inverse of the byte and bit shuffling of Blosc chunks.

/// Reverses byte shuffling, which stores all first bytes of elements of `element` bytes, then all second bytes, and so on. An incomplete element at
/// the end is not shuffled.
pub(crate) fn unshuffled_bytes(block: &mut [u8], element: usize) {
    let count = block.len() / element;
    let shuffled = block[..count * element].to_vec();
    for (place, bytes) in shuffled.chunks_exact(count.max(1)).enumerate() {
        for (into, byte) in block.chunks_exact_mut(element).zip(bytes) {
            into[place] = *byte;
        }
    }
}

/// Reverses bit shuffling, which stores the first bits of all elements, then the second bits, and so on. Only a multiple of eight elements is shuffled.
pub(crate) fn unshuffled_bits(block: &mut [u8], element: usize) {
    let count = block.len() / element;
    if !count.is_multiple_of(8) {
        return;
    }
    let shuffled = block[..count * element].to_vec();
    block[..count * element].fill(0);
    for (plane, bits) in shuffled.chunks_exact((count / 8).max(1)).enumerate() {
        let (place, bit) = (plane / 8, plane % 8);
        for (eight, byte) in block.chunks_exact_mut(element * 8).zip(bits) {
            for (into, number) in eight.chunks_exact_mut(element).zip(0..) {
                into[place] |= (byte >> number & 1) << bit;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shuffled_bytes_are_put_back() {
        let mut block = *b"aAbBc";
        unshuffled_bytes(&mut block[..4], 2);
        assert_eq!(&block, b"abABc");
        let mut odd = [1, 3, 5, 2, 4, 6, 7];
        unshuffled_bytes(&mut odd, 2);
        assert_eq!(odd, [1, 2, 3, 4, 5, 6, 7]);
    }

    #[test]
    fn shuffled_bits_are_put_back() {
        // Elements 0 to 7 of one byte: bit 0 is set in 1, 3, 5, 7.
        let mut block = [0b1010_1010, 0b1100_1100, 0b1111_0000, 0, 0, 0, 0, 0];
        unshuffled_bits(&mut block, 1);
        assert_eq!(block, [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
