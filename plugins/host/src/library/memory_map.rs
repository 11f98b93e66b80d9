//! Memory map of this process. The map is used to check pointers of a library before they are read.

use std::io;
use std::ops::Range;

/// Readable address ranges of this process at one moment.
pub(super) struct Mapped {
    /// Address ranges, sorted and disjoint.
    ranges: Vec<Range<usize>>,
}

impl Mapped {
    /// Reads the current memory map.
    pub(super) fn now() -> io::Result<Mapped> {
        let text = std::fs::read_to_string("/proc/self/maps")?;
        Ok(Mapped::parse(&text))
    }

    fn parse(text: &str) -> Mapped {
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for line in text.lines() {
            let Some((range, rest)) = line.split_once(' ') else {
                continue;
            };
            let Some((from, to)) = range.split_once('-') else {
                continue;
            };
            let address = |digits| usize::from_str_radix(digits, 16).ok();
            let (Some(from), Some(to)) = (address(from), address(to)) else {
                continue;
            };
            if !rest.starts_with('r') {
                continue;
            }
            match ranges.last_mut() {
                Some(last) if last.end == from => last.end = to,
                _ => ranges.push(from..to),
            }
        }
        Mapped { ranges }
    }

    /// True if all `length` bytes at `address` are readable.
    pub(super) fn holds(&self, address: usize, length: usize) -> bool {
        let Some(end) = address.checked_add(length) else {
            return false;
        };
        self.ranges
            .iter()
            .any(|range| range.start <= address && end <= range.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_range_and_what_cannot_be_read_is_none() {
        let text = "1000-2000 r--p 0 0:0 0\n2000-3000 r-xp 0 0:0 0 /lib/x.so\n3000-4000 ---p 0 0:0 0\nodd\n";
        let mapped = Mapped::parse(text);
        assert!(mapped.holds(0x1ff8, 16));
        assert!(!mapped.holds(0x2ff8, 16));
        assert!(!mapped.holds(0x3000, 1));
        assert!(!mapped.holds(usize::MAX, 2));
    }

    #[test]
    fn what_this_program_reads_is_mapped() {
        static TEXT: &str = "text";
        let mapped = Mapped::now().expect("readable");
        assert!(mapped.holds(TEXT.as_ptr().addr(), TEXT.len()));
        assert!(!mapped.holds(8, 8));
    }
}
