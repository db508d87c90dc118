# ncvet in a small image: docker build -t ncvet . && docker run --rm -v "$PWD:/work" ncvet check
FROM debian:12 AS build
COPY . /src
WORKDIR /src
RUN ./dev package

FROM debian:12-slim
COPY --from=build /src/build/package/*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/*.deb && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["ncvet"]
CMD ["check"]
