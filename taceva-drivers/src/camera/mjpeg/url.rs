//! URL of the image stream of a camera.

use std::str::FromStr;

use thiserror::Error;

use crate::text::shown;

/// URL such as `http://192.168.1.20:8080/?action=stream`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Url {
    pub(super) host: String,
    pub(super) port: u16,
    /// Path and query of the URL, beginning with `/`.
    pub(super) path: String,
}

/// Error: the text is not a valid URL of an image stream.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`url`: `{}`: {problem}; expected `http://host:port/path`", shown(.text))]
pub(super) struct UrlError {
    text: String,
    problem: &'static str,
}

impl FromStr for Url {
    type Err = UrlError;

    fn from_str(text: &str) -> Result<Url, UrlError> {
        let wrong = |problem| UrlError {
            text: text.to_owned(),
            problem,
        };
        // The URL is written into a request line, so it must not end that line.
        if text.contains(|letter: char| letter.is_control() || letter == ' ') {
            return Err(wrong("it contains a space or a control character"));
        }
        let rest = text
            .strip_prefix("http://")
            .ok_or_else(|| wrong("it does not begin with `http://`, the only supported scheme"))?;
        let (place, path) = match rest.find(['/', '?']) {
            Some(at) => rest.split_at(at),
            None => (rest, ""),
        };
        if place.contains('@') {
            return Err(wrong(
                "it contains a user name or password, which would be sent unencrypted",
            ));
        }
        let (host, port) = match place.strip_prefix('[') {
            Some(inner) => {
                let (host, rest) = inner
                    .split_once(']')
                    .ok_or_else(|| wrong("a bracket is not closed"))?;
                (host, rest.strip_prefix(':'))
            }
            None => match place.rsplit_once(':') {
                Some((host, port)) => (host, Some(port)),
                None => (place, None),
            },
        };
        let port = match port {
            None => 80,
            Some(port) => port
                .parse()
                .map_err(|_| wrong("its port is not a number up to 65535"))?,
        };
        if host.is_empty() {
            return Err(wrong("it names no host"));
        }
        let slash = if path.starts_with('/') { "" } else { "/" };
        Ok(Url {
            host: host.to_owned(),
            port,
            path: format!("{slash}{path}"),
        })
    }
}

impl Url {
    /// Text of the HTTP request for the image stream at this URL.
    pub(super) fn request(&self) -> String {
        let Url { host, port, path } = self;
        let host = if host.contains(':') {
            format!("[{host}]")
        } else {
            host.clone()
        };
        format!(
            "GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nAccept: multipart/x-mixed-replace, */*\r\nConnection: close\r\n\r\n"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Url, UrlError> {
        text.parse()
    }

    #[test]
    fn addresses_of_cameras_are_read() {
        let url = parse("http://192.168.1.20:8080/?action=stream").expect("good");
        assert_eq!((url.host.as_str(), url.port), ("192.168.1.20", 8080));
        assert_eq!(url.path, "/?action=stream");
        let url = parse("http://gsr0001.local").expect("good");
        assert_eq!((url.port, url.path.as_str()), (80, "/"));
        let url = parse("http://[::1]:81?x").expect("good");
        assert_eq!((url.host.as_str(), url.port), ("::1", 81));
        assert!(url.request().contains("Host: [::1]:81\r\n"));
    }

    #[test]
    fn what_is_no_address_or_would_write_into_the_request_is_refused() {
        for text in [
            "",
            "https://a/",
            "rtsp://a/",
            "http://",
            "http://:80/",
            "http://a:b/",
            "http://a:99999/",
            "http://me:secret@a/",
            "http://[::1/",
            "http://a/x\r\nHost: b",
            "http://a/x y",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
