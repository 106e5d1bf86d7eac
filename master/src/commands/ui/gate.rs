//! Who is answered: a browser on this machine that knows the secret of the address.
//!
//! ```text
//! Host      127.0.0.1:PORT or localhost:PORT     another name that leads to this machine (DNS rebinding) is refused
//! Origin    absent, or the page's own            a page from elsewhere in the same browser is refused
//! path      /TOKEN/…                             whoever was not told the address is refused
//! ```

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};

/// Knows what must be kept.
pub struct Gate {
    port: u16,
    token: String,
}

/// What of a request is looked at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Request<'a> {
    /// Path with query.
    pub url: &'a str,
    /// Whether it is a POST.
    pub posts: bool,
    /// Header Host.
    pub host: Option<&'a str>,
    /// Header Origin.
    pub origin: Option<&'a str>,
    /// Header Sec-Fetch-Site.
    pub site: Option<&'a str>,
}

/// What a request that is let in asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Asked {
    /// A file of the page.
    File(String),
    /// A verb, of a job that may be empty.
    Verb(String, String),
}

/// Why a request is refused: status and sentence.
pub type Refusal = (u16, &'static str);

impl Gate {
    /// With a new secret of 128 bits, made of the keys that the system gives every hash map.
    pub fn new(port: u16) -> Self {
        let part = |n: u64| {
            let mut hasher = RandomState::new().build_hasher();
            hasher.write_u64(n);
            format!("{:016x}", hasher.finish())
        };
        Self { port, token: part(1) + &part(2) }
    }

    /// What is told to the user.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// What is asked for.
    ///
    /// # Errors
    /// The request is refused.
    pub fn pass(&self, request: &Request) -> Result<Asked, Refusal> {
        let names = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        if !request.host.is_some_and(|host| names.iter().any(|name| host.eq_ignore_ascii_case(name))) {
            return Err((403, "only 127.0.0.1 and localhost are answered"));
        }
        let own = |origin: &str| names.iter().any(|name| origin.eq_ignore_ascii_case(&format!("http://{name}")));
        if request.origin.is_some_and(|origin| !own(origin)) {
            return Err((403, "pages of other origins are not answered"));
        }
        if request.site.is_some_and(|site| !matches!(site, "same-origin" | "none")) && request.posts {
            return Err((403, "pages of other origins are not answered"));
        }
        let (path, query) = request.url.split_once('?').unwrap_or((request.url, ""));
        let mut parts = path.trim_start_matches('/').splitn(2, '/');
        if !equal(parts.next().unwrap_or_default(), &self.token) {
            return Err((403, "the address that `ttb ui` has printed is needed, with its secret"));
        }
        let Some(rest) = parts.next() else { return Err((404, "the address ends with a slash")) };
        match (rest.strip_prefix("api/"), request.posts) {
            (Some(verb), true) => {
                let job = query.split('&').find_map(|pair| pair.strip_prefix("job=")).unwrap_or_default();
                Ok(Asked::Verb(verb.into(), job.into()))
            }
            (None, false) => Ok(Asked::File(if rest.is_empty() { "index.html" } else { rest }.into())),
            _ => Err((405, "files are got, verbs are posted")),
        }
    }
}

/// Compares without telling by its time how much is equal.
fn equal(a: &str, b: &str) -> bool {
    a.len() == b.len() && a.bytes().zip(b.bytes()).fold(0, |differs, (a, b)| differs | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_does_not_know_the_secret_or_comes_from_elsewhere_is_refused() {
        let gate = Gate::new(4711);
        let url = format!("/{}/api/look?job=a", gate.token);
        let good = Request { url: &url, posts: true, host: Some("127.0.0.1:4711"), ..Request::default() };
        assert_eq!(gate.pass(&good), Ok(Asked::Verb("look".into(), "a".into())));
        let own = Request { origin: Some("http://localhost:4711"), site: Some("same-origin"), ..good };
        assert!(gate.pass(&own).is_ok());
        let refused = [
            Request { host: None, ..good },
            Request { host: Some("evil.example:4711"), ..good },
            Request { host: Some("127.0.0.1"), ..good },
            Request { host: Some("127.0.0.1:80"), ..good },
            Request { origin: Some("http://evil.example"), ..good },
            Request { origin: Some("http://127.0.0.1:80"), ..good },
            Request { origin: Some("null"), ..good },
            Request { site: Some("cross-site"), ..good },
            Request { site: Some("same-site"), ..good },
            Request { url: "/api/look", ..good },
            Request { url: "/", posts: false, ..good },
            Request { url: "", posts: false, ..good },
            Request { posts: false, ..good },
        ];
        for request in refused {
            assert!(gate.pass(&request).is_err(), "{request:?}");
        }
        let other = Gate::new(4711);
        assert!(gate.token != other.token && other.pass(&good).is_err());
    }

    #[test]
    fn the_bare_address_is_the_page() {
        let gate = Gate::new(1);
        for rest in ["/", "/index.html", "/?x"] {
            let url = format!("/{}{rest}", gate.token);
            let request = Request { url: &url, host: Some("localhost:1"), ..Request::default() };
            assert_eq!(gate.pass(&request), Ok(Asked::File("index.html".into())), "{url}");
        }
    }
}
