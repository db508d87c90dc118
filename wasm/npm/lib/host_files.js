// The module's files are those of the computer: its file system's functions, by Node's.
'use strict';

const fs = require('node:fs');
const tty = require('node:tty');

/** Errors by the numbers that the module's C library has for them. */
const errorNumbers = {
  EACCES: 2,
  EAGAIN: 6,
  EBADF: 8,
  EBUSY: 10,
  EEXIST: 20,
  EFBIG: 22,
  EINVAL: 28,
  EIO: 29,
  EISDIR: 31,
  ELOOP: 32,
  EMFILE: 33,
  ENAMETOOLONG: 37,
  ENOENT: 44,
  ENOSPC: 51,
  ENOSYS: 52,
  ENOTDIR: 54,
  ENOTEMPTY: 55,
  ENOTTY: 59,
  EPERM: 63,
  EPIPE: 64,
  EROFS: 69,
  ETXTBSY: 74,
  EXDEV: 75
};
/** Flags of `open` as the module's C library has them. */
const openFlags = {
  1: 'O_WRONLY',
  2: 'O_RDWR',
  0o100: 'O_CREAT',
  0o200: 'O_EXCL',
  0o1000: 'O_TRUNC',
  0o2000: 'O_APPEND',
  0o4000: 'O_NONBLOCK',
  0o200000: 'O_DIRECTORY',
  0o400000: 'O_NOFOLLOW'
};
/** A stream that has nothing yet is asked again after so many milliseconds. */
const patience = 5;

const isWindows = process.platform === 'win32';
/** The module writes the paths of a drive as `/c:/parts`. */
const toHost = (path) => (isWindows ? path.replace(/^\/(?=[A-Za-z]:)/, '') : path);
const fromHost = (path) => (isWindows ? `/${path.replaceAll('\\', '/')}` : path);

function flagsOf(flags) {
  let result = 0;
  for (const [bit, name] of Object.entries(openFlags))
    if (flags & Number(bit)) result |= fs.constants[name] ?? 0;
  return result;
}

const pause = new Int32Array(new SharedArrayBuffer(4));

/** A stream that does not wait, as those of a parent process may be, is waited for. */
function waitFor(action) {
  for (;;) {
    try {
      return action();
    } catch (error) {
      if (error.code !== 'EAGAIN') throw error;
      Atomics.wait(pause, 0, 0, patience);
    }
  }
}

/** The functions that take a path, by their names in Node. */
const byPath = {
  chmod: 'chmodSync',
  lstat: 'lstatSync',
  mkdir: 'mkdirSync',
  readlink: 'readlinkSync',
  rmdir: 'rmdirSync',
  stat: 'statSync',
  truncate: 'truncateSync',
  unlink: 'unlinkSync'
};

class HostFiles {
  constructor(FS) {
    this.FS = FS;
  }

  cwd() {
    return fromHost(process.cwd());
  }
  chdir(path) {
    process.chdir(toHost(path));
  }
  rename(from, to) {
    fs.renameSync(toHost(from), toHost(to));
  }
  symlink(target, path) {
    fs.symlinkSync(toHost(target), toHost(path));
  }
  readdir(path) {
    return ['.', '..', ...fs.readdirSync(toHost(path))];
  }

  /** What lists of folders ask of an entry: its number and its kind. */
  node(path) {
    const { ino, mode } = fs.lstatSync(toHost(path));
    return { id: ino, mode, path };
  }
  lookupPath(path, options) {
    if (options?.parent) path = path.replace(/\/[^/]*\/*$/, '') || '/';
    return { path, node: this.node(path) };
  }
  lookupNode(parent, name) {
    return this.node(`${parent.path}/${name}`);
  }
  nodePermissions() {
    return 0; // whoever opens a file is told
  }

  open(path, flags, mode) {
    const host = fs.openSync(toHost(path), flagsOf(flags), mode);
    const { ino, mode: kind } = fs.fstatSync(host);
    const stream = {
      fd: this.FS.nextfd(3),
      host,
      path,
      flags,
      position: 0,
      seekable: (kind & fs.constants.S_IFMT) === fs.constants.S_IFREG,
      node: { id: ino, mode: kind, path }
    };
    this.FS.streams[stream.fd] = stream;
    return stream;
  }
  close(stream) {
    if (stream.host > 2) fs.closeSync(stream.host);
    this.FS.closeStream(stream.fd);
  }
  ftruncate(fd, length) {
    fs.ftruncateSync(this.FS.streams[fd].host, length);
  }
  fchmod(fd, mode) {
    fs.fchmodSync(this.FS.streams[fd].host, mode);
  }
  /** Times in milliseconds. */
  utime(path, accessed, modified) {
    fs.utimesSync(toHost(path), accessed / 1000, modified / 1000);
  }
  llseek(stream, offset, whence) {
    const from = [0, stream.position, whence === 2 ? fs.fstatSync(stream.host).size : 0][whence];
    stream.position = from + offset;
    return stream.position;
  }

  /** Where to read or write: of what is no file the place is not known. */
  placeIn(stream, position) {
    return stream.seekable ? (position ?? stream.position) : null;
  }
  read(stream, heap, offset, length, position) {
    let count = 0;
    try {
      const bytes = new Uint8Array(heap.buffer, heap.byteOffset + offset, length);
      count = waitFor(() =>
        fs.readSync(stream.host, bytes, 0, length, this.placeIn(stream, position))
      );
    } catch (error) {
      if (error.code !== 'EOF') throw error; // the end of a pipe, on Windows
    }
    if (position === undefined) stream.position += count;
    return count;
  }
  write(stream, heap, offset, length, position) {
    const bytes = new Uint8Array(heap.buffer, heap.byteOffset + offset, length);
    const isAppended = stream.flags & 0o2000;
    const place = isAppended ? null : this.placeIn(stream, position);
    const count = waitFor(() => fs.writeSync(stream.host, bytes, 0, length, place));
    if (position === undefined) stream.position += count;
    return count;
  }

  /** Files are read instead, which takes no longer. */
  mmap() {
    throw Object.assign(new Error('files are read'), { code: 'ENOSYS' });
  }
}

function useHostFiles(module) {
  const { FS } = module;
  const files = new HostFiles(FS);
  const told =
    (action) =>
    (...words) => {
      try {
        return action(...words);
      } catch (error) {
        if (!error.code || error instanceof FS.ErrnoError) throw error;
        throw new FS.ErrnoError(errorNumbers[error.code] ?? errorNumbers.EIO);
      }
    };
  for (const name of Object.getOwnPropertyNames(HostFiles.prototype))
    if (!['constructor', 'node', 'placeIn'].includes(name))
      FS[name] = told((...words) => files[name](...words));
  for (const [name, inNode] of Object.entries(byPath))
    FS[name] = told((path, ...words) => fs[inNode](toHost(path), ...words));
  for (const fd of [0, 1, 2])
    FS.streams[fd] = {
      fd,
      host: fd,
      path: `/dev/fd/${fd}`,
      flags: fd ? 1 : 0,
      position: 0,
      seekable: false,
      tty: tty.isatty(fd)
    };
}

module.exports = { useHostFiles };
