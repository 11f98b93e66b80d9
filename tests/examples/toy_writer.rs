//! Runs one of the toy protocols: `toy_writer PROTOCOL`, in the current folder. Prints `ACK n` when the protocol states that record n is durable.
#![expect(clippy::print_stdout, reason = "the power-cut test reads the output")]

use std::fs::{File, OpenOptions};
use std::io::{self, Write};

use taceva_tests::toy::{HEADER, JOURNAL, Protocol, RECORDS, framed, new_header, payload};

fn main() -> io::Result<()> {
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let protocol = Protocol::ALL
        .into_iter()
        .find(|protocol| protocol.to_string() == wanted)
        .ok_or_else(|| io::Error::other(format!("no protocol `{wanted}`")))?;
    if protocol.is_journal() {
        append(protocol)
    } else {
        replace(protocol)
    }
}

fn replace(protocol: Protocol) -> io::Result<()> {
    let target = match protocol {
        Protocol::Overwrite => HEADER,
        _ => "header.partial",
    };
    let mut file = File::create(target)?;
    file.write_all(&new_header())?;
    if matches!(
        protocol,
        Protocol::RenameSynced | Protocol::RenameSyncedFolder
    ) {
        file.sync_all()?;
    }
    if protocol != Protocol::Overwrite {
        std::fs::rename(target, HEADER)?;
    }
    if protocol == Protocol::RenameSyncedFolder {
        File::open(".")?.sync_all()?;
    }
    println!("ACK 1");
    Ok(())
}

fn append(protocol: Protocol) -> io::Result<()> {
    let mut journal = OpenOptions::new().append(true).create(true).open(JOURNAL)?;
    if protocol == Protocol::Journal {
        journal.sync_all()?;
        File::open(".")?.sync_all()?;
    }
    for number in 0..RECORDS {
        let record = match protocol {
            Protocol::JournalUnframed => payload(number),
            _ => framed(&payload(number)),
        };
        journal.write_all(&record)?;
        if protocol != Protocol::JournalUnsynced {
            journal.sync_data()?;
        }
        println!("ACK {}", number + 1);
    }
    Ok(())
}
