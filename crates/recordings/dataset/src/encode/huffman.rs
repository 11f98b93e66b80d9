//! Huffman codes with a maximum length of their code words.

use super::bits::Bits;

/// Length of the code word of each symbol for the frequencies `counts`, at most `longest` bits. Unused symbols have length 0.
pub(super) fn lengths<const SYMBOLS: usize>(
    counts: &[u32; SYMBOLS],
    longest: usize,
) -> [u8; SYMBOLS] {
    let mut used: Vec<usize> = (0..SYMBOLS).filter(|symbol| counts[*symbol] != 0).collect();
    used.sort_by_key(|symbol| counts[*symbol]);
    let sorted: Vec<u32> = used.iter().map(|symbol| counts[*symbol]).collect();
    let mut lengths = [0; SYMBOLS];
    let mut by_count = used.iter().rev();
    for (length, words) in (0..).zip(words_by_length(&sorted, longest)) {
        for symbol in by_count.by_ref().take(words) {
            lengths[*symbol] = length;
        }
    }
    lengths
}

/// Code words of the canonical code with the lengths `lengths`, at most 15 bits each.
pub(super) fn words<const SYMBOLS: usize>(lengths: &[u8; SYMBOLS]) -> [Bits; SYMBOLS] {
    let mut words = [Bits::default(); SYMBOLS];
    let mut next: u16 = 0;
    for length in 1..=15 {
        next <<= 1;
        for (word, _) in words
            .iter_mut()
            .zip(lengths)
            .filter(|(_, own)| **own == length)
        {
            // A stream stores the lowest bit of a number first, but the first bit of a code word is its highest.
            let reversed = next.reverse_bits() >> (16 - length);
            *word = Bits::new(reversed, length);
            next = next.wrapping_add(1);
        }
    }
    words
}

/// Number of code words of each length, for the frequencies `counts` in ascending order.
fn words_by_length(counts: &[u32], longest: usize) -> Vec<usize> {
    let mut words = vec![0; longest + 1];
    for depth in leaf_depths(counts) {
        words[depth.min(longest)] += 1;
    }
    // Words cut to the limit overfill the code. Each step moves one of them beside a shorter word, which grows by a bit.
    let taken: usize = (1..=longest)
        .map(|length| words[length] << (longest - length))
        .sum();
    for _ in 1 << longest..taken {
        words[longest] -= 1;
        if let Some(shorter) = (1..longest).rev().find(|length| words[*length] != 0) {
            words[shorter] -= 1;
            words[shorter + 1] += 2;
        }
    }
    words
}

/// Depth of each leaf of the Huffman tree, which joins the two rarest nodes until one node is left. Among equally rare nodes, leaves are joined
/// first.
fn leaf_depths(counts: &[u32]) -> Vec<usize> {
    let leaves = counts.len();
    if leaves < 2 {
        return vec![1; leaves];
    }
    let mut nodes = counts.to_vec();
    let mut parents = vec![0; 2 * leaves - 1];
    let (mut leaf, mut joined) = (0, leaves);
    for parent in leaves..2 * leaves - 1 {
        let mut sum = 0;
        for _ in 0..2 {
            let is_leaf = leaf < leaves && (joined == parent || nodes[leaf] <= nodes[joined]);
            let next = if is_leaf { &mut leaf } else { &mut joined };
            sum += nodes[*next];
            parents[*next] = parent;
            *next += 1;
        }
        nodes.push(sum);
    }
    let mut depths = vec![0; 2 * leaves - 1];
    for node in (0..2 * leaves - 2).rev() {
        depths[node] = depths[parents[node]] + 1;
    }
    depths.truncate(leaves);
    depths
}
