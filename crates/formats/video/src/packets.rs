//! Clips whose packets are JPEG files. Each packet is a whole frame, which is returned unchanged.

use std::ops::ControlFlow;

use crate::clip::Picture;
use crate::error::VideoError;
use crate::jpeg::{self, JpegHeader};
use crate::limits;
use crate::source::Source;

/// Location of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Packet {
    /// Byte offset in the file.
    pub(crate) offset: u64,
    /// Size, bytes.
    pub(crate) size: u64,
}

/// Packets of a clip in presentation order.
#[derive(Debug)]
pub(crate) struct JpegClip {
    pub(crate) source: Source,
    pub(crate) packets: Vec<Packet>,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl JpegClip {
    /// Calls `each` with the frames whose indices are in `sorted`.
    pub(crate) fn visit(
        &self,
        sorted: &[u64],
        each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), VideoError> {
        for &index in sorted {
            let packet = usize::try_from(index)
                .ok()
                .and_then(|at| self.packets.get(at));
            let Some(&packet) = packet else {
                return Err(VideoError::NoFrame {
                    path: self.source.path().to_owned(),
                    index,
                    frames: self.packets.len() as u64,
                });
            };
            let (bytes, header) = read_packet(&self.source, packet)?;
            if (header.width, header.height) != (self.width, self.height) {
                return Err(VideoError::ChangedSize {
                    path: self.source.path().to_owned(),
                    frame: index,
                    found: format!("{}×{}", header.width, header.height),
                    expected: format!("{}×{}", self.width, self.height),
                });
            }
            if each(index, Picture::Jpeg(jpeg::with_tables(bytes, &header))).is_break() {
                break;
            }
        }
        Ok(())
    }
}

/// Reads a packet and parses its JPEG header.
pub(crate) fn read_packet(
    source: &Source,
    packet: Packet,
) -> Result<(Vec<u8>, JpegHeader), VideoError> {
    let bytes = source.read(
        packet.offset,
        packet.size,
        "bytes of a packet",
        limits::PACKET_BYTES,
    )?;
    let header = jpeg::read_header(&bytes)
        .map_err(|(at, problem)| source.damaged(packet.offset + at as u64, problem))?;
    Ok((bytes, header))
}
