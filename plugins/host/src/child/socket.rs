//! Packet sockets between two processes. A packet is read completely or not at all, and may contain files.

use std::io::{IoSlice, IoSliceMut};
use std::mem::MaybeUninit;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};

use rustix::io::Errno;
use rustix::net::{
    AddressFamily, RecvAncillaryBuffer, RecvAncillaryMessage, RecvFlags, ReturnFlags,
    SendAncillaryBuffer, SendAncillaryMessage, SendFlags, SocketFlags, SocketType, recv, recvmsg,
    send, sendmsg, socketpair,
};

use super::wire::{MESSAGE_MAX, Malformed, Reader, Wire, decode, encode};

/// Maximum number of files per packet.
const FILES_MAX: usize = 4;

/// Ancillary buffer for the files of one packet.
type FileSpace = [MaybeUninit<u8>; rustix::cmsg_space!(ScmRights(FILES_MAX))];

/// One end of a socket pair, with buffers for outgoing and incoming packets.
#[derive(Debug)]
pub(crate) struct Socket {
    file: OwnedFd,
    outgoing: Vec<u8>,
    /// Buffer for one incoming packet, always [`MESSAGE_MAX`] bytes.
    incoming: Vec<u8>,
}

/// Failure to send or to receive a packet.
#[derive(Debug)]
pub(crate) enum LinkError {
    /// The other end is closed.
    Closed,
    /// The other end broke the protocol.
    Breach(String),
    /// The message cannot be sent.
    Unsendable(String),
}

impl Socket {
    /// Creates a socket pair. Both ends close on `exec`.
    pub(crate) fn pair() -> Result<(Socket, OwnedFd), Errno> {
        let (ours, theirs) = socketpair(
            AddressFamily::UNIX,
            SocketType::SEQPACKET,
            SocketFlags::CLOEXEC,
            None,
        )?;
        Ok((Socket::from(ours), theirs))
    }

    /// Sends a message with files.
    pub(crate) fn send(
        &mut self,
        message: &impl Wire,
        files: &[BorrowedFd<'_>],
    ) -> Result<(), LinkError> {
        encode(message, &mut self.outgoing)
            .map_err(|error| LinkError::Unsendable(error.to_string()))?;
        send_packet(self.file.as_fd(), &self.outgoing, files)
    }

    /// Waits for a message without files.
    pub(crate) fn receive<T: Wire>(&mut self) -> Result<T, LinkError> {
        // A truncated packet reports its true length. The kernel closes files that came with it.
        let received = retry(|| recv(&self.file, &mut self.incoming[..], RecvFlags::TRUNC))?;
        message(&self.incoming, received.1)
    }

    /// Waits for a message and its files.
    pub(crate) fn receive_with_files<T: Wire>(&mut self) -> Result<(T, Vec<OwnedFd>), LinkError> {
        let mut space: FileSpace = [MaybeUninit::uninit(); _];
        let mut beside = RecvAncillaryBuffer::new(&mut space);
        let received = retry(|| {
            recvmsg(
                &self.file,
                &mut [IoSliceMut::new(&mut self.incoming)],
                &mut beside,
                RecvFlags::CMSG_CLOEXEC,
            )
        })?;
        let files = beside
            .drain()
            .filter_map(|message| match message {
                RecvAncillaryMessage::ScmRights(files) => Some(files),
                _ => None,
            })
            .flatten()
            .collect();
        if received.flags.contains(ReturnFlags::TRUNC) {
            return Err(too_long());
        }
        Ok((message(&self.incoming, received.bytes)?, files))
    }
}

impl From<OwnedFd> for Socket {
    fn from(file: OwnedFd) -> Socket {
        Socket {
            file,
            outgoing: Vec::new(),
            incoming: vec![0; MESSAGE_MAX],
        }
    }
}

impl AsFd for Socket {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.file.as_fd()
    }
}

/// Requesting end of a socket. Each answer repeats the number of its request, so that answers without a request are detected.
#[derive(Debug)]
pub(crate) struct Caller {
    socket: Socket,
    sequence: u32,
}

impl Caller {
    /// Sends a request and waits for the answer.
    pub(crate) fn ask<A: Wire>(
        &mut self,
        question: &impl Wire,
        files: &[BorrowedFd<'_>],
    ) -> Result<A, LinkError> {
        self.sequence = self.sequence.wrapping_add(1);
        self.socket
            .send(&Numbered(self.sequence, question), files)?;
        let (sequence, answer) = self.socket.receive::<(u32, A)>()?;
        if sequence == self.sequence {
            Ok(answer)
        } else {
            Err(LinkError::Breach(
                "an answer without a pending call".to_owned(),
            ))
        }
    }
}

impl From<Socket> for Caller {
    fn from(socket: Socket) -> Caller {
        Caller {
            socket,
            sequence: 0,
        }
    }
}

impl AsFd for Caller {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.socket.as_fd()
    }
}

/// Borrowed message with the number of its request. The receiver reads a pair of number and message.
struct Numbered<'a, T>(u32, &'a T);

impl<T: Wire> Wire for Numbered<'_, T> {
    fn write(&self, into: &mut Vec<u8>) {
        self.0.write(into);
        self.1.write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Malformed> {
        Err(from.malformed("an owned message"))
    }
}

/// Sends a message without blocking. Fails if the socket is full.
pub(crate) fn send_now(socket: BorrowedFd<'_>, message: &impl Wire) -> Result<(), LinkError> {
    let mut packet = Vec::new();
    encode(message, &mut packet).map_err(|error| LinkError::Unsendable(error.to_string()))?;
    let flags = SendFlags::NOSIGNAL | SendFlags::DONTWAIT;
    retry(|| send(socket, &packet, flags)).map(|_| ())
}

/// Receives a message without blocking; `None` if none has arrived.
pub(crate) fn try_receive<T: Wire>(socket: BorrowedFd<'_>) -> Result<Option<T>, LinkError> {
    let mut packet = vec![0; MESSAGE_MAX];
    let flags = RecvFlags::TRUNC | RecvFlags::DONTWAIT;
    loop {
        match recv(socket, &mut packet[..], flags) {
            Ok(received) => return message(&packet, received.1).map(Some),
            Err(Errno::AGAIN) => return Ok(None),
            Err(Errno::INTR) => {}
            Err(_) => return Err(LinkError::Closed),
        }
    }
}

fn send_packet(
    socket: BorrowedFd<'_>,
    packet: &[u8],
    files: &[BorrowedFd<'_>],
) -> Result<(), LinkError> {
    if files.is_empty() {
        return retry(|| send(socket, packet, SendFlags::NOSIGNAL)).map(|_| ());
    }
    let mut space: FileSpace = [MaybeUninit::uninit(); _];
    let mut beside = SendAncillaryBuffer::new(&mut space);
    if files.len() > FILES_MAX || !beside.push(SendAncillaryMessage::ScmRights(files)) {
        let many = format!("{} files, expected at most {FILES_MAX}", files.len());
        return Err(LinkError::Unsendable(many));
    }
    retry(|| {
        sendmsg(
            socket,
            &[IoSlice::new(packet)],
            &mut beside,
            SendFlags::NOSIGNAL,
        )
    })
    .map(|_| ())
}

fn message<T: Wire>(packet: &[u8], received: usize) -> Result<T, LinkError> {
    match received {
        // No message is empty, so length 0 means a closed socket.
        0 => Err(LinkError::Closed),
        _ => {
            let packet = packet.get(..received).ok_or_else(too_long)?;
            decode(packet).map_err(|error| LinkError::Breach(error.to_string()))
        }
    }
}

fn too_long() -> LinkError {
    LinkError::Breach(format!("a message of more than {MESSAGE_MAX} bytes"))
}

fn retry<T>(mut call: impl FnMut() -> Result<T, Errno>) -> Result<T, LinkError> {
    loop {
        match call() {
            Ok(done) => return Ok(done),
            Err(Errno::INTR) => {}
            Err(Errno::PIPE | Errno::CONNRESET | Errno::NOTCONN) => return Err(LinkError::Closed),
            Err(Errno::AGAIN) => {
                return Err(LinkError::Breach("it no longer reads messages".to_owned()));
            }
            Err(error) => return Err(LinkError::Breach(error.to_string())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_travel_beside_a_message_and_the_end_is_seen() {
        let (mut ours, theirs) = Socket::pair().expect("a pair");
        let mut theirs = Socket::from(theirs);
        let (_, other) = Socket::pair().expect("a pair");
        ours.send(&7_u64, &[other.as_fd()]).expect("sent");
        let (number, files) = theirs.receive_with_files::<u64>().expect("there");
        assert_eq!((number, files.len()), (7, 1));
        drop(ours);
        assert!(matches!(theirs.receive::<u64>(), Err(LinkError::Closed)));
    }

    #[test]
    fn a_packet_that_is_too_long_or_no_message_is_a_breach() {
        let (ours, theirs) = Socket::pair().expect("a pair");
        let mut theirs = Socket::from(theirs);
        send_packet(ours.as_fd(), &vec![0; MESSAGE_MAX + 1], &[]).expect("sent");
        assert!(matches!(theirs.receive::<u64>(), Err(LinkError::Breach(_))));
        send_packet(ours.as_fd(), &vec![0; MESSAGE_MAX + 1], &[]).expect("sent");
        let with_files = theirs.receive_with_files::<u64>();
        assert!(matches!(with_files, Err(LinkError::Breach(_))));
        send_packet(ours.as_fd(), &[1, 2, 3], &[]).expect("sent");
        assert!(matches!(theirs.receive::<u64>(), Err(LinkError::Breach(_))));
    }

    #[test]
    fn more_files_than_a_message_carries_are_refused() {
        let (mut ours, theirs) = Socket::pair().expect("a pair");
        let files = [theirs.as_fd(); FILES_MAX + 1];
        assert!(matches!(
            ours.send(&1_u64, &files),
            Err(LinkError::Unsendable(_))
        ));
    }
}
