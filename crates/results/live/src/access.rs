//! Access control: accepts only requests from the page of this server, opened at the printed address.

use crate::request::Request;
use crate::response::Status;
use crate::token::Token;

/// Accepted hosts, origins and token of requests.
#[derive(Debug)]
pub(crate) struct Access {
    /// Accepted values of the HTTP header `Host`.
    hosts: [String; 2],
    pub(crate) token: Token,
}

impl Access {
    /// Creates the access control of a page on `port` of this machine.
    pub(crate) fn new(port: u16, token: Token) -> Access {
        let hosts = ["127.0.0.1", "localhost"].map(|host| format!("{host}:{port}"));
        Access { hosts, token }
    }

    /// Rejects a request to another host, or from a page of another origin.
    pub(crate) fn check_origin(&self, request: &Request) -> Result<(), Status> {
        let is_own = |host: &[u8]| self.hosts.iter().any(|own| own.as_bytes() == host);
        if !request.host.as_deref().is_some_and(is_own) {
            return Err(Status::Misdirected);
        }
        match &request.origin {
            None => Ok(()),
            // The origin must have the same host name: browsers treat the two names as two origins.
            Some(origin) if origin.strip_prefix(b"http://") == request.host.as_deref() => Ok(()),
            Some(_) => Err(Status::Forbidden),
        }
    }

    /// Rejects a request without the token.
    pub(crate) fn check_token(&self, request: &Request) -> Result<(), Status> {
        let given = request.token.as_deref();
        match given.is_some_and(|given| self.token.is(given)) {
            true => Ok(()),
            false => Err(Status::Unauthorized),
        }
    }
}
