# The programs in a container: the first stage builds the Debian package, the second one installs it.
#   docker build -t bem .
#   docker run --rm -v "$PWD":/data bem bemsim scene.json -o out
FROM debian:12-slim AS build
COPY . /source
WORKDIR /source
RUN ./scripts/setup.sh --npm \
 && cmake --preset release -DBEM_BUILD_TESTS=OFF -DBEM_BUILD_VIEWER=ON \
 && cmake --build --preset release \
 && cd build/release && cpack -G DEB -B /packages

FROM debian:12-slim
COPY --from=build /packages/bem_*.deb /packages/
RUN apt-get update \
 && apt-get install -y --no-install-recommends /packages/bem_*.deb python3 python3-numpy python3-h5py python3-pil fonts-dejavu-core ffmpeg \
 && rm -rf /packages /var/lib/apt/lists/*
ENV BEM_CACHE=/data/.cache/bem
WORKDIR /data
CMD ["bemsim", "--help"]
