//! Segments of a JPEG in order, and the decoder state that they set for the scans.

use super::bits::big_endian;
use super::frame::Frame;
use super::huffman::Huffman;
use super::scan::{Scan, Tables};

/// Reader of the segments of a file.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    position: usize,
    tables: Tables,
    frame: Option<Frame>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Reader<'a> {
        Reader {
            bytes,
            position: 0,
            tables: Tables::default(),
            frame: None,
        }
    }

    pub(super) fn read_all(mut self) -> Result<(), String> {
        if self.marker()? != 0xD8 {
            return Err("no start marker".to_owned());
        }
        loop {
            match self.marker()? {
                0xD9 => break,
                0xC4 => self.huffman_tables()?,
                0xDB => self.quantisers()?,
                0xDD => {
                    let body = self.body()?;
                    self.tables.restart_interval = match body {
                        [_, _] => big_endian(body),
                        _ => return Err("the restart interval is truncated".to_owned()),
                    };
                }
                kind @ 0xC0..=0xC2 => {
                    let body = self.body()?;
                    if self.frame.is_some() {
                        return Err("a second frame header".to_owned());
                    }
                    self.frame = Some(Frame::parse(body, kind == 0xC2)?);
                }
                0xC3 | 0xC5..=0xC7 | 0xC9..=0xCB | 0xCD..=0xCF => {
                    return Err("lossless and arithmetic coding are not supported".to_owned());
                }
                0xDA => self.scan()?,
                0xD0..=0xD7 => return Err("a restart marker outside of a scan".to_owned()),
                0x01 => {}
                _ => drop(self.body()?),
            }
        }
        let frame = self.frame.ok_or("no frame before the end marker")?;
        frame.check_complete()
    }

    /// Type of the marker at the current position.
    fn marker(&mut self) -> Result<u8, String> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        let fills = rest.iter().take_while(|byte| **byte == 0xFF).count();
        match rest.get(fills) {
            None => Err("cut short: the file ends before its end marker".to_owned()),
            Some(kind) if fills > 0 && *kind != 0 => {
                self.position += fills + 1;
                Ok(*kind)
            }
            Some(_) => Err(format!("no marker at byte {}, expected one", self.position)),
        }
    }

    /// The content of a segment after its length.
    fn body(&mut self) -> Result<&'a [u8], String> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        let cut = || format!("JPEG segment at byte {} is truncated", self.position);
        let length = big_endian(rest.get(..2).ok_or_else(cut)?);
        let body = rest.get(2..length).ok_or_else(cut)?;
        self.position += length;
        Ok(body)
    }

    fn huffman_tables(&mut self) -> Result<(), String> {
        let mut body = self.body()?;
        while let [place, rest @ ..] = body {
            let cut = "a Huffman table is truncated";
            let (counts, rest) = rest.split_first_chunk::<16>().ok_or(cut)?;
            let total = counts.iter().map(|count| usize::from(*count)).sum();
            let symbols = rest.get(..total).ok_or(cut)?;
            let (kind, number) = (usize::from(place >> 4), usize::from(place & 15));
            let of_kind = self.tables.huffman.get_mut(kind);
            let slot = of_kind.and_then(|tables| tables.get_mut(number));
            *slot.ok_or("a Huffman table has an invalid number")? =
                Some(Huffman::new(counts, symbols)?);
            body = &rest[total..];
        }
        Ok(())
    }

    fn quantisers(&mut self) -> Result<(), String> {
        let mut body = self.body()?;
        while let [place, rest @ ..] = body {
            let cut = "a quantisation table is truncated";
            let width = if place >> 4 == 0 { 1 } else { 2 };
            let table = rest.get(..64 * width).ok_or(cut)?;
            let slot = self.tables.quantisers.get_mut(usize::from(place & 15));
            *slot.ok_or("a quantisation table has a number above 3")? =
                Some(big_endian(&table[..width]));
            body = &rest[64 * width..];
        }
        Ok(())
    }

    fn scan(&mut self) -> Result<(), String> {
        let body = self.body()?;
        let frame = self
            .frame
            .as_mut()
            .ok_or("a scan before the frame header")?;
        let scan = Scan::parse(body, frame)?;
        self.position = scan.read(frame, &self.tables, self.bytes, self.position)?;
        Ok(())
    }
}
